// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "farlod/box.hpp"
#include "generator/building_plan.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {

/// A block while it is being built on.
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

/// A lot is a part of a block's side: from u to u + width.
struct LotSpan {
  double begin_m, width_m;
};

/// Cuts a side from `begin_m` to `end_m` into lots of random width in about [narrowest, widest], without rest.
[[nodiscard]] std::vector<LotSpan> cut_into_lots(KeyedRandom& random, LotSpan side, double narrowest_m, double widest_m);

/// The frame of something that stands `u_m` along and `v_m` behind the corner of `lot`.
[[nodiscard]] LotFrame moved(const LotFrame& lot, double u_m, double v_m);

/// Walls of so many storeys, with a parapet or a knee wall of random height.
void set_storeys(BlockSite& site, BuildingPlan& plan, int storeys);

/// Puts a pitched roof on a low building: gabled or hipped, rising by a random pitch.
void set_pitched_roof(BlockSite& site, BuildingPlan& plan, double gabled_share);

/// Draws whether the ground floor stands back under the upper ones; has an effect where the settings ask for overhangs, and
/// where the building is a tall enough rectangle. Its roof is flat then.
void maybe_add_arcade(BlockSite& site, BuildingPlan& plan, double share);

// The kinds of block. Each draws from the site's random numbers and appends to its plans.

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
