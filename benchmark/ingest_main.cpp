// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "console/peak_memory.hpp"
#include "ingest/ingest.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod {
namespace {

constexpr double bytes_per_mb = 1e6;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One row of the table. Reading uses one core; its time is the processor's, which other programs do not lengthen.
void measure(const std::filesystem::path& file, const ingest::IngestSettings& settings, int turns) {
  std::vector<double> seconds;
  std::size_t buildings = 0, polygons = 0, problems = 0;
  for (int turn = 0; turn < turns; ++turn) {
    Report report;
    const double start = processor_seconds();
    const SourceCity source = ingest::ingest(file, settings, report);
    seconds.push_back(processor_seconds() - start);
    buildings = source.city.buildings().size();
    polygons = surface_count(source.city);
    problems = report.problems().size();
  }
  std::nth_element(seconds.begin(), seconds.begin() + turns / 2, seconds.end());
  const double median_s = seconds[static_cast<std::size_t>(turns / 2)];
  const double size_mb = static_cast<double>(std::filesystem::file_size(file)) / bytes_per_mb;
  fmt::print("| {} | {:.1f} | {} | {} | {} | {:.2f} | {:.0f} | {:.0f} |\n", file.filename().string(), size_mb, buildings,
             polygons, problems, median_s, size_mb / median_s, peak_memory_mib());
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
