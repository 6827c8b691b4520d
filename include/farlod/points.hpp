// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// Points in the package's CRS, coordinate by coordinate. The n-th is (x_m[n], y_m[n]), at the height z_m[n] above sea level
/// where there is one. It looks where azimuth[n] and tilt[n] say, or straight up where there are none. The arrays are the
/// caller's, and as long as each other.
struct Points {
  /// Easting and northing, within 100,000 km, and within 2²⁹ cells of the package's origin.
  std::span<const double> x_m, y_m;
  std::span<const double> z_m = {};  ///< within 100 km, or NaN: the point stands as Placing says; empty: all do
  /// Normals, both or neither. The azimuth is clockwise from true north, from −360° to 360°. A tilt of 0° looks straight up, of
  /// 90° level, of 180° straight down; NaN: straight up, whatever the azimuth.
  std::span<const Angle> azimuth = {}, tilt = {};
  /// Heights above the ground of points without a z_m, 0 to 10,000, or NaN: the point stands as Placing says; empty: all do.
  std::span<const double> above_ground_m = {};
};

/// How far from the north-up rectangle around the grid (PackageDescription::outline_projected) receivers have answers: what
/// stands farther away is not known.
inline constexpr double answered_beyond_grid_m = 200.0;

/// Where the answers go: arrays of the caller as long as those of the points. No data is NaN.
struct PointAnswerSpans {
  std::span<float> svf;             ///< from 0 to 1
  std::span<float> low = {};        ///< wanted with EvaluationSettings::bounds, and only then
  std::span<float> high = {};       ///< the same
  std::span<double> height_m = {};  ///< where the receivers stand, above sea level; may be empty
  /// Wanted with EvaluationSettings::further, and only then: a value for each of columns_of, point by point.
  std::span<float> further = {};
  /// How high the receivers stand above the ground; NaN also where there is none. May be empty.
  std::span<double> above_ground_m = {};
};

struct PointAnswers {
  std::vector<float> svf, low, high;  ///< `low` and `high` are empty without EvaluationSettings::bounds
  std::vector<double> height_m;
  std::vector<float> further;  ///< a value for each of columns_of(EvaluationSettings::further), point by point
  EvaluationSummary summary;
  std::vector<double> above_ground_m = {};  ///< NaN also where there is no ground
};

/// Evaluates the sky view factors of points, inside the grid or up to answered_beyond_grid_m from it; those farther away have no
/// data (EvaluationSummary::beyond_grid). The same points give the same answers whatever the number of threads. Throws
/// InvalidArgument (InvalidPoint for a point that lies nowhere), Cancelled, LimitReached, PackageUnusable, PackageDamaged.
FARLOD_EXPORT EvaluationSummary evaluate_points(const Package& package, const Points& points, const Placing& placing,
                                                const EvaluationSettings& settings, const PointAnswerSpans& answers,
                                                const RunSettings& run = {});
[[nodiscard]] FARLOD_EXPORT PointAnswers evaluate_points(const Package& package, const Points& points,
                                                         const Placing& placing = {}, const EvaluationSettings& settings = {},
                                                         const RunSettings& run = {});

}  // namespace farlod
