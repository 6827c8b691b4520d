// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "console/run_options.hpp"
#include "generator/city_settings.hpp"
#include "generator/city_writer.hpp"

namespace farlod {

struct CityOptions {
  CitySettings settings;
  std::filesystem::path output;
  CityFormat format = CityFormat::obj;
  bool obj_from_centre = false;
  std::filesystem::path trees;  ///< empty: none are written
  RunOptions run;
};

/// The options, or the exit code after --help, --version or an error that was printed.
struct ParsedCityOptions {
  std::optional<CityOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedCityOptions parse_city_options(int argc, char** argv);

/// The counts of a generated city.
struct CityCounts {
  std::uint64_t buildings = 0, polygons = 0, towers = 0, bridges = 0, trees = 0;
  double tallest_m = 0.0;  ///< of one building, from its base
  double seconds = 0.0;
  std::uint64_t bytes = 0;
};

/// The text of `--summary`.
[[nodiscard]] std::string city_summary_json(const CityOptions& options, const CityCounts& counts);

}  // namespace farlod
