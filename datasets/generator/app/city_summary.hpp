// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "generator/app/city_options.hpp"

namespace farlod {

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
