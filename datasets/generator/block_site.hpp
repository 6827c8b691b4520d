// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "farlod/box.hpp"
#include "generator/generated_building.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {

/// A block, the random numbers for it, and the plans of its buildings so far.
struct BlockSite {
  const CitySettings& settings;
  Box2d rectangle;
  double urbanity;
  KeyedRandom random;
  std::vector<BuildingPlan> plans;

  [[nodiscard]] double width_m() const { return rectangle.high.x - rectangle.low.x; }
  [[nodiscard]] double depth_m() const { return rectangle.high.y - rectangle.low.y; }
  /// The first of the two longer sides: lots face it and its opposite.
  [[nodiscard]] int long_side() const { return width_m() >= depth_m() ? 0 : 1; }
};

/// The part of a side of a block that a lot occupies: from u to u + width.
struct LotSpan {
  double begin_m, width_m;
};

/// Divides a side into lots of random width between about `narrowest_m` and `widest_m`, without remainder.
[[nodiscard]] std::vector<LotSpan> cut_into_lots(KeyedRandom& random, LotSpan side, double narrowest_m, double widest_m);

/// The frame whose origin is `u_m` along and `v_m` behind the corner of `lot`.
[[nodiscard]] LotFrame moved(const LotFrame& lot, double u_m, double v_m);

/// Walls of so many storeys, with a parapet or a knee wall of random height.
void set_storeys(BlockSite& site, BuildingPlan& plan, int storeys);

/// Puts a pitched roof on a low building: gabled or hipped, rising by a random pitch.
void set_pitched_roof(BlockSite& site, BuildingPlan& plan, double gabled_share);

/// Decides at random whether a building gets an arcade, which makes its roof flat. Only with `overhangs`, and only for rectangles
/// that are high enough.
void maybe_add_arcade(BlockSite& site, BuildingPlan& plan, double share);

// The kinds of block. Each function uses the random numbers of the site and appends to its plans.

/// Houses in gardens, one row along each of the longer sides, single or in pairs, some with an outbuilding.
void build_detached_houses(BlockSite& site);
/// Terraces of touching houses, one row along each of the longer sides, with gardens behind.
void build_terraces(BlockSite& site);
/// Closed street fronts around a yard, with L-shaped corner buildings and outbuildings in the yard.
void build_street_fronts(BlockSite& site);
/// Offices, courtyard buildings and towers on large lots.
void build_core(BlockSite& site);
/// Parallel slabs of flats on a lawn.
void build_slabs(BlockSite& site);
/// Low buildings of large footprint.
void build_halls(BlockSite& site);
/// A park, sometimes with a pavilion.
void build_park(BlockSite& site);

}  // namespace farlod
