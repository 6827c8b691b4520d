// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// What a direction meets.
enum class SkyPart : std::uint8_t {
  sky,
  near,  ///< geometry of the neighborhood, which may hide far geometry behind it
  far,   ///< geometry beyond the neighborhood alone
  crown  ///< the crown of a tree, with sky or anything else behind it
};

/// What a receiver sees when it looks up, direction by direction: parts of equal angles in azimuth and in elevation.
struct Hemisphere {
  /// Parts of the turn, clockwise from true north, and of the right angle, from the horizontal upwards.
  std::size_t azimuths = 0, elevations = 0;
  std::vector<SkyPart> parts;  ///< of the middles of the parts, azimuth by azimuth
  /// For each azimuth, the tangent of the elevation above which all is sky; infinite where that is nothing.
  std::vector<float> horizon;
  double height_m = 0.0;  ///< of the receiver, above sea level
  float svf = 0.0F;       ///< what evaluate_points answers
  EvaluationSummary summary;
  std::vector<float> further = {};  ///< a value for each of columns_of(EvaluationSettings::further)

  [[nodiscard]] SkyPart part(std::size_t azimuth, std::size_t elevation) const { return parts[azimuth * elevations + elevation]; }
};

/// How finely look_up divides the hemisphere: quarters of a degree.
inline constexpr std::size_t hemisphere_azimuths = 1440, hemisphere_elevations = 360;

/// Looks up at one place of the package's CRS, at a height above sea level or as Placing says; empty where there is no answer, as
/// inside a building. Directions are decided as the engine of the place decides its answer. Throws what evaluate_points throws.
[[nodiscard]] FARLOD_EXPORT std::optional<Hemisphere> look_up(const Package& package, Point2d place_m,
                                                              std::optional<double> height_m = {}, const Placing& placing = {},
                                                              const EvaluationSettings& settings = {},
                                                              const RunSettings& run = {});

}  // namespace farlod
