// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/horizon_map_baker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/grid.hpp"
#include "farmap/occlusion_culler.hpp"
#include "package/far_map.hpp"
#include "package/horizon_edge.hpp"
#include "package/tile_set.hpp"
#include "tests/determinism/threads.hpp"
#include "tests/oracles/far_view.hpp"
#include "tests/preprocess/farmap/sight.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

using test::Chance;

/// An edge of the far city of a cell (frame of that cell), and how a block would store it if it were explicit.
struct FarThing {
  Point3d a, b;
  std::array<std::array<float, 3>, 2> stored;  ///< both ends in the frame of the block's south-west cell
  AdjacentSlopes adjacent = {};
  EdgeRole role = EdgeRole::grounded;

  [[nodiscard]] bool is_upper() const { return role != EdgeRole::underside; }
  auto operator<=>(const FarThing& o) const { return std::tie(role, stored) <=> std::tie(o.role, o.stored); }
};

/// Everything outside of a cell's neighborhood, tile by tile.
std::vector<FarThing> far_city(const TileSet& tiles, const Grid& grid, Cell cell) {
  const Point2d block_corner = grid.corner_of(grid.cells_of(grid.block_of(cell)).cell_at(0));
  std::vector<FarThing> things;
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    const Cell place = tiles.cells.cell_at(n);
    if (grid.neighborhood_of(cell).contains(place)) continue;
    const Point2d shift = grid.corner_of(place) - grid.corner_of(cell), in_block = grid.corner_of(place) - block_corner;
    const auto placed = [&](const Point3f& p) { return Point3d{p.x + shift.x, p.y + shift.y, p.z}; };
    const auto stored = [&](const Point3f& p) {
      return std::array<float, 3>{static_cast<float>(p.x + in_block.x), static_cast<float>(p.y + in_block.y), p.z};
    };
    for (const HorizonEdge& e : tiles.tiles[n].horizon_edges)
      things.push_back({placed(e.a), placed(e.b), {stored(e.a), stored(e.b)}, e.adjacent, e.role});
  }
  return things;
}

/// Whether an edge is no silhouette for anybody in a cell: what goes on beyond it is there by other edges.
bool faces_away(const FarThing& t, const BakedHorizon& map, double cell_edge_m) {
  return !may_be_silhouette(t.a, t.b, t.adjacent, t.role, {{0.0, 0.0}, {cell_edge_m, cell_edge_m}},
                            map.patches.levels_m().front(), std::max(t.a.z, t.b.z));
}

/// The explicit occluders of a cell's map for one of its patches.
std::set<FarThing> explicit_in(const BakedHorizons& block, const BakedHorizon& map, std::uint32_t patch) {
  const auto stored = [](const Point3f& p) { return std::array<float, 3>{p.x, p.y, p.z}; };
  std::set<FarThing> things;
  for (const package::ExplicitOccluder& occluder : map.explicit_edges) {
    const HorizonEdge& e = block.edges[occluder.row];
    if (is_explicit_in(occluder, map.patches, patch)) things.insert({{}, {}, {stored(e.a), stored(e.b)}, e.adjacent, e.role});
  }
  return things;
}

/// A place in a patch. Of the uppermost, which has no lid, one in its first 40 m.
Point3d place_in(const PatchBox& box, Chance& chance) {
  return {chance.between(box.low.x, box.high.x), chance.between(box.low.y, box.high.y),
          chance.between(box.z_low_m, std::min(box.z_high_m, box.z_low_m + 40.0))};
}

constexpr int places_asked = 60;

struct BakedTown {
  std::string name;
  CitySettings city;
  double cell_edge_m = 30.0;
  int neighborhood = 3;
  Assign assign = Assign::clip;
};

CitySettings city_of(std::uint64_t seed, int lod, bool overhangs, double relief_m) {
  return {.size_m = 420,
          .seed = seed,
          .rotation_deg = 10,
          .tower_share = 0.5,
          .terrain_relief_m = relief_m,
          .lod = lod,
          .overhangs = overhangs};
}

std::vector<BakedTown> towns() {
  return {{"flat", city_of(1, 1, false, 0)},
          {"overhangs", city_of(2, 2, true, 0)},
          {"hills", city_of(3, 2, true, 60)},
          {"nothing_near_but_the_cell", city_of(4, 1, true, 0), 40.0, 1},
          {"whole", city_of(5, 2, true, 0), 30.0, 3, Assign::whole},
          {"whole_small_cells", city_of(6, 1, true, 30), 15.0, 1, Assign::whole}};
}

/// A town, cut, and the maps of the block in its middle.
struct Baked {
  Grid grid;
  TileSet tiles;
  CellRange cells;
  BakedHorizons block;
};

Baked bake(const BakedTown& town, const HorizonMapSettings& settings = {}) {
  const CityModel city = scenes::generated_town(town.city);
  Report ignored;
  Baked baked;
  baked.grid = scenes::grid_covering(city, Angle::degrees(4), town.cell_edge_m, town.neighborhood, 5);
  baked.tiles = tiles::cut_into_tiles({city, {}}, baked.grid, town.assign, {}, ignored);
  const Block middle = baked.grid.block_of(baked.grid.cell_of({0, 0}));
  baked.cells = baked.grid.cells_of(middle);
  baked.block = HorizonMapBaker(baked.tiles, baked.grid, settings).bake(middle);
  return baked;
}

/// A random place of a random patch of a random cell.
struct Place {
  Cell cell;
  const BakedHorizon& map;
  std::uint32_t patch;
  Point3d eye;
  [[nodiscard]] float low(std::uint32_t bin, std::uint32_t bins) const { return map.low[patch * bins + bin]; }
  [[nodiscard]] float high(std::uint32_t bin, std::uint32_t bins) const { return map.high[patch * bins + bin]; }
  [[nodiscard]] float overhang(std::uint32_t bin, std::uint32_t bins) const { return map.overhang[patch * bins + bin]; }
};

Place random_place(const Baked& baked, Chance& chance) {
  const std::size_t n = chance.below(baked.block.cells.size());
  const BakedHorizon& map = baked.block.cells[n];
  const auto patch = static_cast<std::uint32_t>(chance.below(map.patches.count()));
  return {baked.cells.cell_at(n), map, patch, place_in(map.patches.box(patch), chance)};
}

class HorizonMaps : public testing::TestWithParam<BakedTown> {};

TEST_P(HorizonMaps, AllThatIsResidualAndDoesNotFaceAwayLiesBelowHigh) {
  const Baked baked = bake(GetParam());
  const AzimuthBins bins;
  Chance chance(7);
  std::size_t explicit_count = 0, bounded = 0, away = 0;
  for (int n = 0; n < places_asked; ++n) {
    const Place place = random_place(baked, chance);
    const auto explicit_things = explicit_in(baked.block, place.map, place.patch);
    for (const FarThing& thing : far_city(baked.tiles, baked.grid, place.cell)) {
      if (!thing.is_upper()) continue;
      const bool is_away = faces_away(thing, place.map, baked.grid.cell_edge_m);
      ++(is_away ? away : explicit_things.contains(thing) ? explicit_count : bounded);
      if (is_away || explicit_things.contains(thing)) continue;
      for (const double share : {0.0, 1.0, chance.between(0, 1), chance.between(0, 1)}) {
        const Point3d p = test::point_between(thing.a, thing.b, share);
        const test::Sight sight = test::sight_of(p, place.eye, bins);
        ASSERT_LE(sight.slope, place.high(sight.bin, bins.count)) << "place " << n << ", patch " << place.patch;
      }
    }
  }
  EXPECT_GT(explicit_count, 0U);
  EXPECT_GT(bounded, explicit_count) << "the test would not test much";
  EXPECT_GT(bounded, away / 2) << "the test would not test much";
}

/// The horizon that residual things make which are grounded.
double residual_ground(const std::vector<FarThing>& things, const std::set<FarThing>& explicit_things, const Point3d& eye,
                       double azimuth) {
  double horizon = 0.0;
  for (const FarThing& thing : things)
    if (thing.role == EdgeRole::grounded && !explicit_things.contains(thing))
      horizon = std::max(horizon, test::slope_at(azimuth, thing.a, thing.b, eye).value_or(0.0));
  return horizon;
}

TEST_P(HorizonMaps, ResidualLowerBordersLieBelowOverhangOrBeforeHigherGroundedThings) {
  const Baked baked = bake(GetParam());
  const AzimuthBins bins;
  Chance chance(11);
  std::size_t bounded = 0, hidden = 0;
  for (int n = 0; n < places_asked; ++n) {
    const Place place = random_place(baked, chance);
    const auto explicit_things = explicit_in(baked.block, place.map, place.patch);
    const auto things = far_city(baked.tiles, baked.grid, place.cell);
    for (const FarThing& thing : things) {
      if (thing.is_upper() || explicit_things.contains(thing) || faces_away(thing, place.map, baked.grid.cell_edge_m)) continue;
      const Point3d p = test::point_between(thing.a, thing.b, chance.between(0, 1));
      const test::Sight sight = test::sight_of(p, place.eye, bins);
      if (sight.slope <= place.overhang(sight.bin, bins.count)) {
        ++bounded;
        continue;
      }
      const Point2d way = horizontal(p) - horizontal(place.eye);
      ASSERT_LE(sight.slope, residual_ground(things, explicit_things, place.eye, std::atan2(way.y, way.x)))
          << "place " << n << ", patch " << place.patch;
      ++hidden;
    }
  }
  EXPECT_EQ(bounded + hidden > 100, GetParam().city.overhangs);
}

TEST_P(HorizonMaps, WhereNothingOverhangsTheRowsOfOverhangsAreLevel) {
  if (GetParam().city.overhangs) return;
  const Baked baked = bake(GetParam());
  for (const BakedHorizon& map : baked.block.cells)
    for (const float slope : map.overhang) ASSERT_EQ(slope, 0.0F);
}

TEST_P(HorizonMaps, AllBelowLowIsHidden) {
  // Small squares: the less eyes move, the more is promised
  HorizonMapSettings settings;
  settings.squares_per_edge = 4;
  const Baked baked = bake(GetParam(), settings);
  const AzimuthBins bins;
  Chance chance(8);
  int promises = 0;
  for (int n = 0; n < places_asked; ++n) {
    const Place place = random_place(baked, chance);
    const auto things = far_city(baked.tiles, baked.grid, place.cell);
    for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
      if (place.low(bin, bins.count) == 0.0F) continue;
      ++promises;
      const double azimuth = (bin + chance.between(0, 1)) * bins.width_rad();
      double horizon = 0.0;
      for (const FarThing& thing : things)
        if (thing.is_upper()) horizon = std::max(horizon, test::slope_at(azimuth, thing.a, thing.b, place.eye).value_or(0.0));
      ASSERT_GE(horizon, place.low(bin, bins.count)) << "place " << n << ", patch " << place.patch << ", bin " << bin;
    }
  }
  EXPECT_GT(promises, places_asked);
}

TEST_P(HorizonMaps, LowIsNotAboveHigh) {
  const Baked baked = bake(GetParam());
  for (const BakedHorizon& map : baked.block.cells)
    for (std::size_t n = 0; n < map.high.size(); ++n) ASSERT_LE(map.low[n], map.high[n]);
}

INSTANTIATE_TEST_SUITE_P(, HorizonMaps, testing::ValuesIn(towns()), [](const auto& town) { return town.param.name; });

/// Four floats are rounded, then added one by one.
constexpr double average_rounding = 4.0 * std::numeric_limits<float>::epsilon();

/// What the corners of a patch's floor see at one azimuth.
struct CornerView {
  double residual = 0.0;  ///< slope, the average of the corners
  double left_out = 0.0;  ///< by how much that may be less, if what is nearly hidden is not looked at
  bool sees_no_explicit = true;
};

CornerView view_from_corners(const std::vector<FarThing>& things, const std::set<FarThing>& explicit_things, const PatchBox& box,
                             double azimuth, double weak_sine) {
  CornerView view;
  for (const Point2d at : {box.low, box.high, Point2d{box.low.x, box.high.y}, Point2d{box.high.x, box.low.y}}) {
    double horizon = 0.0;
    for (const FarThing& thing : things) {
      if (!thing.is_upper()) continue;
      const Point3d eye{at.x, at.y, box.z_low_m};
      const double slope = test::slope_at(azimuth, thing.a, thing.b, eye).value_or(0.0);
      if (explicit_things.contains(thing))
        view.sees_no_explicit = view.sees_no_explicit && slope == 0.0;
      else
        horizon = std::max(horizon, slope);
    }
    view.residual += 0.25 * horizon;
    view.left_out += 0.25 * (horizon - slope_of_sine(std::max(0.0, sine_of_slope(horizon) - weak_sine)));
  }
  return view;
}

TEST(HorizonMapBaker, TheEstimateKnowsOnlyTheResidualCityAndLeavesOutTheWeakest) {
  const HorizonMapSettings settings;
  const Baked baked = bake(towns()[1], settings);
  const AzimuthBins bins;
  Chance chance(9);
  int weak = 0;
  for (int n = 0; n < places_asked; ++n) {
    const Place place = random_place(baked, chance);
    const auto explicit_things = explicit_in(baked.block, place.map, place.patch);
    auto things = far_city(baked.tiles, baked.grid, place.cell);
    std::erase_if(things, [&](const auto& t) { return faces_away(t, place.map, baked.grid.cell_edge_m); });
    const PatchBox box = place.map.patches.box(place.patch);
    for (std::uint32_t bin = 0; bin < bins.count; bin += 5) {
      const double azimuth = (bin + 0.5) * bins.width_rad(), estimate = place.map.estimate[place.patch * bins.count + bin];
      const CornerView seen = view_from_corners(things, explicit_things, box, azimuth, settings.weak_share * settings.tolerance);
      const double rounding = average_rounding * (1.0 + seen.residual);
      ASSERT_LE(estimate, seen.residual + rounding) << "place " << n;
      // Where something explicit is seen, what it nearly hides is left out, however high that is
      if (!seen.sees_no_explicit) continue;
      ASSERT_GE(estimate, seen.residual - seen.left_out - rounding) << "place " << n;
      weak += estimate > 0.0 && sine_of_slope(estimate) < settings.tolerance ? 1 : 0;
    }
  }
  EXPECT_GT(weak, 20) << "the test would not test much";
}

TEST(HorizonMapBaker, ABlockStoresEachExplicitOccluderOnce) {
  const Baked baked = bake(towns()[1]);
  std::vector<int> uses(baked.block.edges.size(), 0);
  for (const BakedHorizon& map : baked.block.cells)
    for (const package::ExplicitOccluder& occluder : map.explicit_edges) ++uses.at(occluder.row);
  ASSERT_FALSE(uses.empty());
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 0), 0);
  EXPECT_GT(*std::max_element(uses.begin(), uses.end()), 1) << "cells share their explicit occluders";
  for (const EdgeRole role : {EdgeRole::grounded, EdgeRole::overhang, EdgeRole::underside})
    EXPECT_TRUE(std::any_of(baked.block.edges.begin(), baked.block.edges.end(), [&](const HorizonEdge& e) {
      return e.role == role;
    })) << static_cast<int>(role);
}

void expect_equal(const std::vector<package::ExplicitOccluder>& a, const std::vector<package::ExplicitOccluder>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n)
    ASSERT_EQ(std::tuple(a[n].row, a[n].squares, a[n].layers), std::tuple(b[n].row, b[n].squares, b[n].layers));
}

TEST(HorizonMapBaker, TheNumberOfThreadsChangesNothing) {
  const Baked once = with_threads(1, [] { return bake(towns()[1]); });
  for (int n = 0; n < repeats; ++n) {
    const Baked again = with_threads(many_threads, [] { return bake(towns()[1]); });
    ASSERT_EQ(once.block.edges, again.block.edges);
    for (std::size_t cell = 0; cell < once.block.cells.size(); ++cell) {
      const BakedHorizon &a = once.block.cells[cell], &b = again.block.cells[cell];
      expect_equal(a.explicit_edges, b.explicit_edges);
      ASSERT_EQ(std::tie(a.low, a.estimate, a.high, a.overhang), std::tie(b.low, b.estimate, b.high, b.overhang));
    }
  }
}

/// The highest row of overhangs of a cell, with a slab that floats 1.5 km away, before a slab or a tower.
float highest_overhang(double tower_foot_m) {
  scenes::SceneBuilder scene;
  scene.add_box({{0, 0}, {5, 5}}, 0.0, 3.0);
  scene.add_box({{1500, -100}, {1510, 100}}, 5.0, 6.0);
  scene.add_box({{1520, -400}, {1560, 400}}, tower_foot_m, 200.0);
  Report ignored;
  const Grid grid = scenes::grid_covering(scene.city(), {}, 50, 1);
  const TileSet tiles = tiles::cut_into_tiles({scene.city(), {}}, grid, Assign::clip, {}, ignored);
  const BakedHorizons maps = HorizonMapBaker(tiles, grid, {}).bake(grid.block_of({0, 0}));
  const BakedHorizon& map = maps.cells.at(grid.cells_of(grid.block_of({0, 0})).index_of({0, 0}));
  return *std::max_element(map.overhang.begin(), map.overhang.end());
}

TEST(HorizonMapBaker, LowerBordersThatAGroundedTowerHidesAreLeftOut) {
  EXPECT_EQ(highest_overhang(0.0), 0.0F);
  EXPECT_GE(highest_overhang(20.0), 20.0F / 1560.0F) << "the tower floats: its own lower border is highest";
}

TEST(HorizonMapBaker, WhereNothingRisesNothingIsExplicit) {
  // One low house in a wide plain: from the far cells, nothing rises by more than the tolerance
  scenes::SceneBuilder scene;
  scene.add_box({{-5, -5}, {5, 5}}, 0.0, 4.0);
  scene.add_box({{400, 400}, {405, 405}}, 0.0, 3.0);
  Report ignored;
  const Grid grid = scenes::grid_covering(scene.city(), {}, 50, 3);
  const TileSet tiles = tiles::cut_into_tiles({scene.city(), {}}, grid, Assign::clip, {}, ignored);
  const BakedHorizons maps = HorizonMapBaker(tiles, grid, {}).bake({0, 0});
  const BakedHorizon& far_away = maps.cells.at(grid.cells_of({0, 0}).index_of({4, 4}));
  EXPECT_TRUE(far_away.explicit_edges.empty());
  EXPECT_GT(*std::max_element(far_away.high.begin(), far_away.high.end()), 0.0F) << "but it is bounded";
}

}  // namespace
}  // namespace farlod
