// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "console/run_program.hpp"
#include "ingest/ingest.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod {
namespace {

constexpr double bytes_per_mb = 1e6;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What was read, and how long that took.
struct Reading {
  std::size_t buildings = 0, polygons = 0, problems = 0;
  double processor_s = 0.0, clock_s = 0.0;
};

Reading read(const std::filesystem::path& file, const ingest::IngestSettings& settings) {
  Report report;
  const double start = processor_seconds();
  const auto start_of_clock = std::chrono::steady_clock::now();
  const SourceCity source = ingest::ingest(file, settings, report);
  const double clock_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_of_clock).count();
  return {source.city.buildings().size(), surface_count(source.city), report.problems().size(), processor_seconds() - start,
          clock_s};
}

/// One row of the table. On one core, the time is the processor's, which other programs do not lengthen; on all, it is the
/// clock's.
void measure(const std::filesystem::path& file, const ingest::IngestSettings& settings, int turns) {
  std::vector<double> one_core_s, all_cores_s;
  Reading reading;
  oneapi::tbb::task_arena one_core(1);
  for (int turn = 0; turn < turns; ++turn) {
    reading = one_core.execute([&] { return read(file, settings); });
    one_core_s.push_back(reading.processor_s);
    all_cores_s.push_back(read(file, settings).clock_s);
  }
  const double size_mb = static_cast<double>(std::filesystem::file_size(file)) / bytes_per_mb;
  fmt::print("| {} | {:.1f} | {} | {} | {} | {:.2f} | {:.0f} | {:.2f} | {:.0f} |\n", file.filename().string(), size_mb,
             reading.buildings, reading.polygons, reading.problems, median(one_core_s), size_mb / median(one_core_s),
             median(all_cores_s), peak_memory_mib());
}

}  // namespace
}  // namespace farlod

/// FILE [TURNS [HEIGHT_FIELD]]
int main(int argc, char** argv) {
  try {
    farlod::ingest::IngestSettings settings;
    settings.footprints.default_height_m = 10.0;
    if (argc > 3) settings.footprints.height_field = argv[3];
    if (argc < 2) throw std::invalid_argument("give FILE [TURNS [HEIGHT_FIELD]]");
    farlod::measure(argv[1], settings, argc > 2 ? std::stoi(argv[2]) : 1);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "farlod-ingest-benchmark: {}\n", error.what());
    return 1;
  }
}
