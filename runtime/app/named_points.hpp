// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/angle.hpp"
#include "farlod/package.hpp"
#include "farlod/points.hpp"
#include "farlod/region.hpp"
#include "inputs/requested_points.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Why a point has no answer.
struct WhyUnanswered {
  std::string words;   ///< the same of all such points, without a comma
  std::string detail;  ///< with its heights, where they are looked up
  /// Where it is in plan, if that was looked up.
  enum class Place : std::uint8_t { unknown, open_ground, building } place = Place::unknown;
};
using Reasons = std::map<std::size_t, WhyUnanswered>;  ///< by the numbers of points

/// Points as the library takes them, and what is written of them besides.
struct NamedPoints {
  std::vector<std::string> ids;
  std::vector<double> x_m, y_m;             ///< NaN where the file says no place that can be used
  std::vector<double> z_m, above_ground_m;  ///< no height is NaN; empty where no point has one above the ground
  std::vector<Angle> azimuth, tilt;         ///< empty where the file has none; no normal is NaN
  Attributes attributes;
  std::vector<std::string> notes;
  std::size_t skipped_features = 0;
  std::string doubtful_z;  ///< as RequestedPoints::doubtful_z

  explicit NamedPoints(RequestedPoints requested);
  /// Leaves out the points outside of a region.
  void keep(const Region& region);
  /// An attribute that is called like one of our columns, or like one before it, comes back under another name: a measured
  /// `svf` beside the computed one.
  void rename_attributes_that_clash(const AnswerColumns& columns);
  /// Adds the column `reason`, which says in a few words why a point has no answer, if one has none.
  void add_reasons(const Reasons& reasons, const AnswerColumns& columns);
  [[nodiscard]] bool has_normals() const { return !tilt.empty(); }
  [[nodiscard]] bool has_place(std::size_t n) const { return !std::isnan(x_m[n]); }
  [[nodiscard]] Points points() const { return {x_m, y_m, z_m, azimuth, tilt, above_ground_m}; }
  /// What it holds for each point, more or less: short ids lie within their string.
  [[nodiscard]] std::size_t bytes() const {
    return ids.size() * (sizeof(std::string) + (has_normals() ? 6 : 4) * sizeof(double)) + attributes.bytes();
  }
};

/// Those of --points, --along or --at, in the CRS of the package. Throws PointsError.
[[nodiscard]] NamedPoints requested_points(const SvfOptions& options, const PackageDescription& package);

/// Whether a place in the CRS of the package is not so far from the city that something is wrong with its coordinates. `notes`
/// tell of those that are.
[[nodiscard]] bool is_near(Point2d p, const PackageDescription& package);

/// The rows of the table. Both must outlive them.
[[nodiscard]] PointRows rows_of(const NamedPoints& named, const PointAnswers& answers);

}  // namespace farlod
