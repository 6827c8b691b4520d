// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/near_buildings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/grid.hpp"
#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "farlod/raster.hpp"
#include "package/package_reader.hpp"
#include "receivers/raster_receivers.hpp"
#include "receivers/receiver.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// Houses across the borders of cells, a lone one, and a slab in the air: within its triangles, sides are more than 20 m away.
const std::vector<Box2d> houses = {{{0.0, 0.0}, {11.0, 9.0}}, {{21.0, 10.0}, {34.0, 21.0}}, {{-60.0, 200.0}, {-56.0, 203.0}}};
const Box2d slab{{40.0, 60.0}, {240.0, 260.0}};

double distance_m(const Box2d& box, Point2d p) {
  return std::hypot(std::max({box.low.x - p.x, p.x - box.high.x, 0.0}), std::max({box.low.y - p.y, p.y - box.high.y, 0.0}));
}

/// The village of these houses, on a grid of small or large cells, turned or not; buildings are cut at the borders or whole.
struct PackedVillage {
  PackedVillage(double bearing_deg, double cell_edge_m, Assign assign) {
    scenes::SceneBuilder builder;
    for (const Box2d& house : houses) builder.add_box(house, 0.0, 6.0);
    builder.add_box(slab, 12.0, 13.0);
    const Grid grid = scenes::grid_covering(builder.city(), Angle::degrees(bearing_deg), cell_edge_m, 1, 4);
    scenes::pack_city(builder.city(), grid, folder.path() / "village.farlod", scenes::box_maps(1, 1), assign);
  }
  [[nodiscard]] PackageReader reader() const { return PackageReader(folder.path() / "village.farlod"); }

  scenes::TemporaryFolder folder;
};

/// Returns how many receivers are near.
std::size_t expect_the_distance_to_say_so(const PackageReader& package, double near_m) {
  const RasterPlan plan = plan_raster(package.manifest(), 3.1, Box2d{{-120.0, -120.0}, {360.0, 380.0}});
  const RasterReceivers receivers(package.manifest(), plan, nullptr, BeyondGrid::is_answered);
  // Places are rounded to floats within their cells
  constexpr double rounding_m = 1e-4;
  std::size_t near_ones = 0, all = 0;
  for (const Cell cell : receivers.cells()) {
    const CellReceivers of_cell = receivers.in_cell(package, cell, HeightAbove::ground, 1.5F);
    const std::vector<bool> is_near = are_near_buildings(package, of_cell, near_m);
    EXPECT_EQ(is_near.size(), of_cell.receivers.size());
    for (std::size_t n = 0; n < is_near.size(); ++n) {
      const std::size_t pixel = of_cell.receivers[n].index;
      const Point2d p = plan.centre_m(pixel % plan.columns, pixel / plan.columns);
      double least_m = distance_m(slab, p);
      for (const Box2d& house : houses) least_m = std::min(least_m, distance_m(house, p));
      if (std::abs(least_m - near_m) > rounding_m) {
        EXPECT_EQ(is_near[n], least_m < near_m) << least_m;
      }
      near_ones += is_near[n] ? 1U : 0U;
      ++all;
    }
  }
  EXPECT_LT(near_ones, all / 2);
  return near_ones;
}

TEST(NearBuildings, AreReceiversWithinTwentyMetresInThePlanWhicheverCellsTheBuildingsLieIn) {
  std::size_t expected = 0;
  for (const double bearing_deg : {0.0, 33.0})
    for (const double cell_edge_m : {16.0, 70.0, 400.0})
      for (const Assign assign : {Assign::clip, Assign::whole}) {
        // Buildings assigned whole are looked for two cells away, here and elsewhere: the slab is larger
        if (assign == Assign::whole && cell_edge_m < 50.0) continue;
        SCOPED_TRACE(std::to_string(bearing_deg) + " degrees, cells of " + std::to_string(cell_edge_m) + " m");
        const PackedVillage village(bearing_deg, cell_edge_m, assign);
        const std::size_t found = expect_the_distance_to_say_so(village.reader(), near_buildings_m);
        if (expected == 0) expected = found;
        EXPECT_EQ(found, expected);
        EXPECT_LT(expect_the_distance_to_say_so(village.reader(), 2.0), found);
        if (assign == Assign::clip) {
          EXPECT_GT(expect_the_distance_to_say_so(village.reader(), 45.0), found);
        }
      }
  EXPECT_GT(expected, 1000U);
}

TEST(NearBuildings, ArePartsOfTheReceiversAsTheyAreAmongAll) {
  const PackedVillage village(33.0, 70.0, Assign::clip);
  const PackageReader package = village.reader();
  const RasterPlan plan = plan_raster(package.manifest(), 1.0, Box2d{{-30.0, -30.0}, {70.0, 60.0}});
  const RasterReceivers receivers(package.manifest(), plan);
  for (const Cell cell : receivers.cells()) {
    const CellReceivers all = receivers.in_cell(package, cell, HeightAbove::ground, 1.5F);
    const std::vector<bool> of_all = are_near_buildings(package, all, near_buildings_m);
    CellReceivers some{cell, {}};
    for (std::size_t n = 0; n < all.receivers.size(); n += 7) some.receivers.push_back(all.receivers[n]);
    const std::vector<bool> of_some = are_near_buildings(package, some, near_buildings_m);
    for (std::size_t n = 0; n < of_some.size(); ++n) EXPECT_EQ(of_some[n], of_all[7 * n]);
  }
}

TEST(NearBuildings, AreNotAskedForOfNoReceivers) {
  const PackedVillage village(0.0, 70.0, Assign::clip);
  EXPECT_TRUE(are_near_buildings(village.reader(), {{0, 0}, {}}, near_buildings_m).empty());
}

}  // namespace
}  // namespace farlod
