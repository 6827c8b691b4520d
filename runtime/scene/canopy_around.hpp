// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "base/grid.hpp"
#include "farlod/point.hpp"
#include "package/crown.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// How far from its axis a crown may reach in the plan, at the most.
[[nodiscard]] inline double reach_m(const Crown& crown) {
  const double half_width_m = crown.half_width_m;
  return crown.shape == CrownShape::prism ? std::numbers::sqrt2 * half_width_m : half_width_m;
}

/// The crowns that reach, in the plan, to within a distance of the square of `cell`, in the frame of `cell`, and perhaps some
/// prisms that just fail to. In the order of the package: cell by cell. Places are moved and rounded as `placed`
/// (occlusion/placed_mesh.hpp) does it.
[[nodiscard]] std::vector<Crown> crowns_near(const PackageReader& package, Cell cell, double distance_m);

/// At least as many as crowns_near gives, and perhaps others nearby.
[[nodiscard]] std::size_t count_crowns_near(const PackageReader& package, Cell cell, double distance_m);

/// All crowns of a package, in the frame of `cell`, in the same order. That of the middle cell has the frame of WholeCity.
[[nodiscard]] std::vector<Crown> crowns_of_whole_city(const PackageReader& package, Cell cell);

/// How crowns are merged that lie far away. What lies farther than `farthest_m` from a cell is left out.
struct CrownMerging {
  double named_m = 100.0;          ///< up to here from a cell each crown counts by itself
  double small_square_m = 25.0;    ///< the crowns of such a square are one crown, up to `small_squares_m`
  double small_squares_m = 300.0;  ///< and from there on those of larger ones
  double large_square_m = 100.0;
  double farthest_m = 3000.0;
};

/// For bounds: squares of one size from where their crowns are low above the level; and no squares at all.
inline constexpr CrownMerging merging_for_bounds{300.0, 100.0, 300.0, 100.0, 3000.0};
inline constexpr CrownMerging no_merging{3000.0, 100.0, 3000.0, 100.0, 3000.0};
/// Where there are more around a cell, as of a raster of canopies, rays take less time and memory than to merge none of them.
inline constexpr std::size_t most_crowns_by_name = 400'000;

/// One crown for several of the same foliage: upright, in their middle, and as wide as they hide together if they stand in a
/// square of this edge by chance. docs/concepts.md, "Crowns far away". There must be one at least.
[[nodiscard]] Crown merged(const std::vector<Crown>& crowns, double square_m);

/// The crowns that receivers of a cell may see, the far ones merged, in the frame of the cell; those that rise above `lowest_m`.
/// The same crowns in the same order at each call.
[[nodiscard]] std::vector<Crown> canopy_around(const PackageReader& package, Cell cell, float lowest_m,
                                               const CrownMerging& merging = {});

/// An upright square prism around all of these crowns, whose foliage is that of the first. There must be one at least.
[[nodiscard]] Crown enclosing(const std::vector<Crown>& crowns);

/// The crowns that receivers of a cell may see, and what encloses those that do not count by themselves.
struct BoundedCanopy {
  std::vector<Crown> crowns;  ///< as canopy_around gives them
  /// In the same frame, a prism for the crowns of each square and foliage, and for the one they are merged to.
  std::vector<Crown> envelopes;
  /// No place of the cell at `lowest_m` or above sees a crown that was left out at a larger slope than this.
  float highest_slope_left_out = 0.0F;
};
[[nodiscard]] BoundedCanopy bounded_canopy_around(const PackageReader& package, Cell cell, float lowest_m,
                                                  const CrownMerging& merging);

}  // namespace farlod
