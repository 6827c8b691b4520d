// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "trial/far_map_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/determinism/threads.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

/// A town with towers and overhangs, cut.
struct Town {
  Grid grid;
  TileSet tiles;
};

Town town(Assign assign = Assign::clip) {
  CitySettings settings{.size_m = 400, .seed = 3, .tower_share = 0.5, .lod = 2, .overhangs = true};
  const CityModel city = scenes::generated_town(settings);
  Town result;
  result.grid = scenes::grid_covering(city, Angle::degrees(7), 30.0, 3);
  Report ignored;
  result.tiles = tiles::cut_into_tiles({city, {}}, result.grid, assign, {}, ignored);
  return result;
}

FarErrorSettings few_receivers() {
  FarErrorSettings settings;
  settings.cells = 12;
  settings.rays = 400;
  return settings;
}

HorizonMapSettings maps_with(double tolerance) {
  HorizonMapSettings settings;
  settings.tolerance = tolerance;
  return settings;
}

TEST(FarMapTrial, FinerMapsErrLessAndHaveMoreExplicitEdges) {
  const Town t = town();
  const FarMapTrial trial(t.tiles, t.grid, Assign::clip, few_receivers());
  const FarErrorEstimate coarse = trial.run(1, maps_with(1.0)), fine = trial.run(1, maps_with(0.02));
  EXPECT_GT(coarse.receivers, 50U);
  EXPECT_EQ(coarse.receivers, fine.receivers);
  // Without the tolerance's choice of explicit edges, a residual horizon alone is off by several percent
  EXPECT_GT(coarse.max_error, 0.01);
  EXPECT_LT(fine.max_error, 0.5 * coarse.max_error);
  EXPECT_LT(fine.mean_error, 0.5 * coarse.mean_error);
  EXPECT_LT(fine.p99_half_width, 0.5 * coarse.p99_half_width);
  EXPECT_GT(fine.explicit_edges_per_cell, 2.0 * coarse.explicit_edges_per_cell);
}

TEST(FarMapTrial, NoAnswerIsOffByMoreThanItsBounds) {
  const Town t = town();
  FarErrorSettings settings = few_receivers();
  settings.receivers_per_cell = 2;  // so few that 99 % are all
  const FarErrorEstimate estimate = FarMapTrial(t.tiles, t.grid, Assign::clip, settings).run(1, maps_with(0.2));
  ASSERT_GT(estimate.receivers, 10U);
  EXPECT_GT(estimate.max_error, 0.0);
  // Rays of one receiver may be blocked in one scene and free in the other by the rounding of floats
  const auto rays = static_cast<double>(settings.rays);
  EXPECT_LE(estimate.max_error, estimate.p99_half_width + 1.0 / rays);
  // Whole rays, without the rounding of answers to floats
  EXPECT_EQ(estimate.max_error, std::round(estimate.max_error * rays) / rays);
  EXPECT_EQ(estimate.p99_half_width, std::round(estimate.p99_half_width * rays) / rays);
}

TEST(FarMapTrial, WhereAllOfTheCityIsNearThereIsNoError) {
  const Town t = town();
  const int all = 2 * static_cast<int>(std::max(t.grid.cells.width(), t.grid.cells.height())) + 1;
  const FarErrorEstimate estimate = FarMapTrial(t.tiles, t.grid, Assign::clip, few_receivers()).run(all, maps_with(0.05));
  EXPECT_GT(estimate.receivers, 50U);
  EXPECT_EQ(estimate.explicit_edges_per_cell, 0.0);
  EXPECT_EQ(estimate.p99_half_width, 0.0);
  // One ray in a thousand may pass a corner on either side
  EXPECT_LT(estimate.mean_error, 1e-3);
  EXPECT_EQ(estimate.near_triangles_per_cell, static_cast<double>(t.tiles.triangle_count()));
}

TEST(FarMapTrial, WorksWithBuildingsThatAreAssignedWhole) {
  const Town t = town(Assign::whole);
  const FarErrorEstimate estimate = FarMapTrial(t.tiles, t.grid, Assign::whole, few_receivers()).run(3, maps_with(0.05));
  EXPECT_GT(estimate.receivers, 50U);
  EXPECT_LT(estimate.max_error, 0.02);
}

TEST(FarMapTrial, TheNumberOfThreadsChangesNothing) {
  const Town t = town();
  const auto try_out = [&] {
    const FarErrorEstimate e = FarMapTrial(t.tiles, t.grid, Assign::clip, few_receivers()).run(3, maps_with(0.05));
    return std::tuple(e.receivers, e.mean_error, e.max_error, e.p99_half_width, e.explicit_edges_per_cell);
  };
  EXPECT_EQ(with_threads(1, try_out), with_threads(4, try_out));
}

}  // namespace
}  // namespace farlod
