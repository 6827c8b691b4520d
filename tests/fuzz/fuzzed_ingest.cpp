// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_ingest.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "farlod/error.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

/// The readers open files by name. A folder in memory, the process's own, goes when the process ends.
class ScratchFolder {
 public:
  ScratchFolder() : path_(root() / ("farlod_fuzz_" + std::to_string(getpid()))) { fs::create_directories(path_); }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  static fs::path root() { return fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path(); }

  fs::path path_;
};

bool is_finite(const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void expect_clean_ring(std::span<const Point3d> ring) {
  FARLOD_EXPECTS(ring.size() >= 3);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    FARLOD_EXPECTS(is_finite(ring[i]));
    FARLOD_EXPECTS(ring[i] != ring[(i + 1) % ring.size()]);
  }
}

void expect_promises_kept(const SourceCity& source) {
  const CityModel& city = source.city;
  FARLOD_EXPECTS(!city.buildings().empty() || !source.relief_points.empty());
  for (const Point3d& p : source.relief_points) FARLOD_EXPECTS(is_finite(p));
  for (const Building& building : city.buildings()) FARLOD_EXPECTS(building.facet_count > 0);
  for (const Facet& facet : city.facets()) {
    FARLOD_EXPECTS(facet.ring_count > 0);
    for (std::uint32_t k = 0; k < facet.ring_count; ++k) expect_clean_ring(city.ring(facet, k));
  }
}

}  // namespace

fs::path write_file(std::span<const std::uint8_t> bytes, std::string_view ending) {
  static const ScratchFolder folder;
  const fs::path file = folder.path() / ("city" + std::string(ending));
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  FARLOD_EXPECTS(stream);
  return file;
}

void ingest_bytes(std::span<const std::uint8_t> bytes, std::string_view ending, const ingest::IngestSettings& settings) {
  Report report;
  try {
    expect_promises_kept(ingest::ingest(write_file(bytes, ending), settings, report));
  } catch (const InputError& refusal) {
    FARLOD_EXPECTS(!std::string_view(refusal.what()).empty());
  }
}

}  // namespace farlod
