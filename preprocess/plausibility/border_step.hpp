// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace farlod::plausibility {

/// By how much a terrain around a city stands above the city's own ground, along the border of the grid.
struct BorderStep {
  double median_m = 0.0;
  bool is_everywhere = false;  ///< nine tenths of the places have a step to the same side, too high for any survey
};

/// The step of these differences, in metres; nothing where it may come from a coarse raster, a slope or a survey: below 10 m, or
/// less than what half of the places differ by.
[[nodiscard]] inline std::optional<BorderStep> border_step(std::vector<double> differences_m) {
  constexpr double least_m = 10.0, impossible_m = 30.0;
  constexpr std::size_t fewest = 8;
  if (differences_m.size() < fewest) return std::nullopt;
  std::ranges::sort(differences_m);
  const auto at = [&](double share) {
    return differences_m[static_cast<std::size_t>(share * static_cast<double>(differences_m.size() - 1))];
  };
  const double median_m = at(0.5);
  if (std::abs(median_m) < std::max(least_m, at(0.75) - at(0.25))) return std::nullopt;
  return BorderStep{median_m, at(0.05) > impossible_m || at(0.95) < -impossible_m};
}

}  // namespace farlod::plausibility
