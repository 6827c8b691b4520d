// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/receiver.hpp"
#include "scene/vertical_profile.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/tiles.hpp"

// A row of houses along a slope that climbs to the east by a fifth, with one level floor: it touches the ground at its uphill
// side, and floats 2 m over the ground at its downhill side.

namespace farlod {
namespace {

constexpr double climb = 0.2, floor_m = 2.0, roof_m = 8.0, depth_m = 10.0, half_length_m = 200.0, eye_m = 1.5;

TerrainRaster slope() {
  TerrainRaster terrain;
  terrain.first = {-100.0, -250.0};
  terrain.step_m = {10.0, 10.0};
  terrain.columns = 21;
  terrain.rows = 51;
  for (std::size_t row = 0; row < terrain.rows; ++row)
    for (std::size_t column = 0; column < terrain.columns; ++column)
      terrain.height_m.push_back(static_cast<float>(climb * terrain.node(column, row).x));
  return terrain;
}

void add_box(CityModel& city, const std::string& id, Point2d low, Point2d high, double bottom_m, double top_m) {
  const std::array plan{low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}};
  const auto at = [&plan](std::size_t k, double z) { return Point3d{plan[k % 4].x, plan[k % 4].y, z}; };
  city.begin_building(id);
  city.begin_facet(SurfaceKind::floor, 0);
  city.add_ring(std::array{at(3, bottom_m), at(2, bottom_m), at(1, bottom_m), at(0, bottom_m)});
  city.begin_facet(SurfaceKind::roof, 1);
  city.add_ring(std::array{at(0, top_m), at(1, top_m), at(2, top_m), at(3, top_m)});
  for (std::uint32_t k = 0; k < 4; ++k) {
    city.begin_facet(SurfaceKind::wall, 2 + k);
    city.add_ring(std::array{at(k, bottom_m), at(k + 1, bottom_m), at(k + 1, top_m), at(k, top_m)});
  }
}

CityModel houses() {
  CityModel city;
  add_box(city, "row", {0, -half_length_m}, {depth_m, half_length_m}, floor_m, roof_m);
  // So that the grid reaches downhill; it is too low to hide anything of the sky
  add_box(city, "bench", {-60, 0}, {-59, 1}, -12.0, -11.5);
  return city;
}

class FloorOnASlope : public testing::TestWithParam<double> {
 protected:
  FloorOnASlope() {
    LocatedCity located{houses(), {}};
    const Grid grid = scenes::grid_covering(located.city, Angle::degrees(GetParam()), 25.0, 3);
    Report report;
    const TileSet tiles = tiles::cut_into_tiles(std::move(located), grid, Assign::clip, slope(), report);
    foundations_ = tiles.foundation_count;
    scenes::pack_tiles(tiles, grid, folder_.path() / "slope.farlod", {});
    package_.emplace(folder_.path() / "slope.farlod");
  }
  /// A receiver at eye height; none where nobody can stand.
  [[nodiscard]] std::optional<CellReceivers> receiver_at(Point2d p_city) const {
    const Grid& grid = package_->grid();
    const Point2d p = grid.rotation.grid_from_city(p_city);
    const Cell cell = grid.cell_of(p);
    const Point2d in_cell = p - grid.corner_of(cell);
    const auto place = stand(PointLocator(*package_, cell), static_cast<float>(in_cell.x), static_cast<float>(in_cell.y),
                             HeightAbove::ground, static_cast<float>(eye_m));
    if (!place) return std::nullopt;
    return CellReceivers{cell, {{0, *place, {0.0F, 0.0F, 1.0F}}}};
  }

  scenes::TemporaryFolder folder_;
  std::optional<PackageReader> package_;
  std::uint64_t foundations_ = 0;
};

TEST_P(FloorOnASlope, GoesDownToTheGround) {
  EXPECT_EQ(foundations_, 1U);
  for (const double x : {0.1, 1.0, 2.4, 5.0, 9.0}) EXPECT_FALSE(receiver_at({x, 3.0})) << "below the floor, at " << x;
}

TEST_P(FloorOnASlope, IsAWallFromBelow) {
  for (const Engine engine : {Engine::exact, Engine::rays, Engine::automatic, Engine::horizon}) {
    SkySettings settings;
    settings.engine = engine;
    settings.rays = 4000;
    settings.azimuths = 1024;
    const SkyEvaluator evaluator(*package_, settings);
    for (const double distance : {1.0, 5.0, 20.0}) {
      const auto r = receiver_at({-distance, 3.0});
      ASSERT_TRUE(r);
      std::array<float, 1> svf{};
      evaluator.evaluate(*r, svf);
      const double above_eye = roof_m - (eye_m - climb * distance);
      EXPECT_NEAR(svf[0], oracles::finite_wall_cos(above_eye, distance, half_length_m - 3.0, half_length_m + 3.0),
                  sampling_error_of(settings))
          << distance << " m in front, engine " << static_cast<int>(engine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Turned, FloorOnASlope, testing::Values(0.0, 23.0));

}  // namespace
}  // namespace farlod
