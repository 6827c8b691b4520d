// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/point_receivers.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>

#include "farlod/error.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;

constexpr double cell_m = 16.0;
/// Heights above the package's origin are below 64 m; a column rounds them twice on the way up its ray and once to the sum, the
/// disk once, in slopes once for each coordinate.
constexpr float rounding_m = 8 * 64.0F * std::numeric_limits<float>::epsilon();

/// A slope that rises from 100 m at the west to 107.75 m at the east, a metre every four; with and without a house.
class Slope : public testing::Test {
 protected:
  Slope() : slope_(packed(false)), with_house_(packed(true)) {}

  static double ground_at(double x) { return 100.0 + 0.25 * x; }

  PackageReader packed(bool with_house) const {
    scenes::SceneBuilder builder;
    // Two low kerbs tell where the ground is
    for (const double x : {0.0, 31.0}) {
      const double low = ground_at(x);
      builder.add_polygon({{x, 0.0, low}, {x, 31.0, low}, {x, 31.0, low + 0.001}, {x, 0.0, low + 0.001}});
    }
    if (with_house) builder.add_box({{18.0, 10.0}, {24.0, 16.0}}, 103.0, 115.0);
    const Grid grid = scenes::grid_covering(builder.city(), {}, cell_m, 1, 4);
    const auto folder = folder_.path() / (with_house ? "house.farlod" : "slope.farlod");
    scenes::pack_city(builder.city(), grid, folder, scenes::box_maps(1, 1));
    return PackageReader(folder);
  }

  /// All receivers at some places, by their index; heights absolute.
  static std::map<std::size_t, double> heights_of(const PackageReader& package, const std::vector<PlaceOfReceiver>& places,
                                                  HeightAbove above, float height_m) {
    std::map<std::size_t, double> heights;
    for (const auto& [cell, chosen] : places_by_cell(package, places))
      for (const Receiver& r : receivers_at(package, cell, places, chosen, above, height_m).receivers) {
        EXPECT_EQ(package.grid().corner_of(cell).x + r.p_cell.x, places[r.index].p_projected.x);
        EXPECT_EQ(package.grid().corner_of(cell).y + r.p_cell.y, places[r.index].p_projected.y);
        heights[r.index] = r.p_cell.z + package.manifest().height_origin_m;
      }
    return heights;
  }

  scenes::TemporaryFolder folder_;
  PackageReader slope_, with_house_;
};

TEST_F(Slope, PlacesComeByCellInTheirOrder) {
  const std::vector<PlaceOfReceiver> places{{{20, 3}, {}}, {{3, 3}, {}}, {{-5, 3}, {}}, {{17, 4}, {}}, {{3, 20}, {}}};
  const auto by_cell = places_by_cell(slope_, places);
  ASSERT_EQ(by_cell.size(), 4U);
  EXPECT_EQ(by_cell[0].first, (Cell{-1, 0}));
  EXPECT_THAT(by_cell[1].second, ElementsAre(1U));
  EXPECT_THAT(by_cell[2].second, ElementsAre(4U));
  EXPECT_EQ(by_cell[3].first, (Cell{1, 0}));
  EXPECT_THAT(by_cell[3].second, ElementsAre(0U, 3U));
}

TEST_F(Slope, ReceiversStandOnTheGround) {
  const std::vector<PlaceOfReceiver> places{{{4, 3}, {}}, {{12, 25}, {}}, {{16, 8}, {}}, {{28, 16}, {}}};
  const auto heights = heights_of(slope_, places, HeightAbove::ground, 1.5F);
  ASSERT_EQ(heights.size(), places.size());
  for (const auto& [n, height] : heights) EXPECT_NEAR(height, ground_at(places[n].p_projected.x) + 1.5, rounding_m);
}

TEST_F(Slope, AnAbsoluteHeightIsTaken) {
  const std::vector<PlaceOfReceiver> places{{{4, 3}, 123.25}, {{-40, 3}, 123.25}};
  const auto heights = heights_of(with_house_, places, HeightAbove::ground, 1.5F);
  EXPECT_EQ(heights.at(0), 123.25);
  EXPECT_EQ(heights.at(1), 123.25);
}

TEST_F(Slope, InsideAHouseIsNowhere) {
  const std::vector<PlaceOfReceiver> places{{{20, 12}, {}}, {{20, 12}, 110.0}, {{20, 12}, 116.0}, {{17, 12}, {}}};
  const auto heights = heights_of(with_house_, places, HeightAbove::ground, 1.5F);
  EXPECT_FALSE(heights.contains(0));
  EXPECT_FALSE(heights.contains(1));
  EXPECT_TRUE(heights.contains(2)) << "above the roof";
  EXPECT_TRUE(heights.contains(3)) << "beside the wall";
}

TEST_F(Slope, OnTheSurfaceIsOnTheRoof) {
  const std::vector<PlaceOfReceiver> places{{{20, 12}, {}}};
  EXPECT_NEAR(heights_of(with_house_, places, HeightAbove::highest_surface, 0.5F).at(0), 115.5, rounding_m);
}

TEST_F(Slope, OutsideOfTheGridTheGroundIsThatOfItsBorder) {
  const std::vector<PlaceOfReceiver> inside{{{0.0, 5}, {}}}, outside{{{-300, 5}, {}}, {{-1, 5}, {}}};
  const double at_border = heights_of(slope_, inside, HeightAbove::ground, 1.5F).at(0);
  EXPECT_NEAR(at_border, 101.5, rounding_m);
  for (const auto& [n, height] : heights_of(slope_, outside, HeightAbove::ground, 1.5F)) EXPECT_EQ(height, at_border) << n;
  EXPECT_EQ(heights_of(slope_, outside, HeightAbove::ground, 1.5F).size(), outside.size());
}

TEST(PointReceivers, OutsideOfTheGridNobodyStandsInAHouse) {
  scenes::SceneBuilder builder;
  // Its west and south walls stand on the grid's border, behind which the receivers are
  builder.add_box({{0.0, 0.0}, {12.0, 12.0}}, 0.0, 8.0);
  const scenes::TemporaryFolder folder;
  const Grid grid = scenes::grid_covering(builder.city(), {}, cell_m, 1, 4);
  scenes::pack_city(builder.city(), grid, folder.path() / "edge.farlod", scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "edge.farlod");
  const std::vector<PlaceOfReceiver> places{{{-100.0, 8.0}, {}}, {{8.0, -100.0}, {}}, {{-100.0, 8.0}, 4.0}};
  std::size_t count = 0;
  for (const auto& [cell, chosen] : places_by_cell(package, places))
    count += receivers_at(package, cell, places, chosen, HeightAbove::ground, 1.5F).receivers.size();
  EXPECT_EQ(count, places.size());
}

constexpr float float_epsilon = std::numeric_limits<float>::epsilon();
/// A coordinate within a cell of 20 m, and the few operations that place a receiver on its triangle.
constexpr float place_error_m = 8 * 20.0F * float_epsilon;

/// Two houses that touch over a part of a wall, over several cells and none of it on a border.
class TouchingHouses : public testing::Test {
 protected:
  TouchingHouses() : package_(packed()) {}

  PackageReader packed() const {
    scenes::SceneBuilder builder;
    builder.add_box({{3.0, 3.0}, {27.0, 17.0}}, 0.0, 9.0);
    builder.add_box({{27.0, 7.0}, {51.0, 33.0}}, 0.0, 6.0);
    const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 2);
    scenes::pack_city(builder.city(), grid, folder_.path() / "houses.farlod", scenes::box_maps(1, 1));
    return PackageReader(folder_.path() / "houses.farlod");
  }

  template <class Visit>
  void for_each(SurfaceChoice choice, double spacing_m, const Visit& visit) const {
    for (std::size_t n = 0; n < static_cast<std::size_t>(package_.grid().cells.size()); ++n) {
      const Cell cell = package_.grid().cells.cell_at(n);
      const TileView tile = package_.tile(cell);
      for (const SurfaceReceiver& r : surface_receivers(package_, cell, choice, spacing_m)) visit(cell, tile, r);
    }
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

TEST_F(TouchingHouses, AreasAddUpToTheSurfaces) {
  for (const double spacing_m : {0.7, 3.0, 100.0}) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>> areas;
    std::size_t receivers = 0;
    for_each(SurfaceChoice::all, spacing_m, [&](Cell, const TileView& tile, const SurfaceReceiver& r) {
      const package::SurfaceRecord& surface = tile.surface_of(r.triangle);
      auto& [sum, whole] = areas[{tile.building_number(surface), surface.number}];
      sum += r.area_m2;
      const Point3d size_m = tile.building_number(surface) == 0 ? Point3d{24.0, 14.0, 9.0} : Point3d{24.0, 26.0, 6.0};
      whole = dot(Point3d{size_m.y * size_m.z, size_m.x * size_m.z, size_m.x * size_m.y},
                  Point3d{std::abs(r.normal.x), std::abs(r.normal.y), std::abs(r.normal.z)});
      ++receivers;
    });
    EXPECT_EQ(areas.size(), 2U * 5U) << "a roof and four walls each";
    // A triangle's area is off by its corners' rounding, each receiver's share by one more
    for (const auto& [surface, area] : areas)
      EXPECT_NEAR(area.first, area.second, area.second * 16 * static_cast<double>(float_epsilon));
    EXPECT_GE(receivers, areas.size());
  }
}

TEST_F(TouchingHouses, RoofsAndWallsAreWhatIsAskedFor) {
  std::map<SurfaceKind, int> roofs, walls, all;
  for_each(SurfaceChoice::roofs, 2.0,
           [&](Cell, const TileView& t, const SurfaceReceiver& r) { ++roofs[t.surface_of(r.triangle).kind()]; });
  for_each(SurfaceChoice::walls, 2.0,
           [&](Cell, const TileView& t, const SurfaceReceiver& r) { ++walls[t.surface_of(r.triangle).kind()]; });
  for_each(SurfaceChoice::all, 2.0,
           [&](Cell, const TileView& t, const SurfaceReceiver& r) { ++all[t.surface_of(r.triangle).kind()]; });
  EXPECT_EQ(roofs.size(), 1U);
  EXPECT_EQ(walls.size(), 1U);
  EXPECT_EQ(all, (std::map<SurfaceKind, int>{{SurfaceKind::roof, roofs[SurfaceKind::roof]},
                                             {SurfaceKind::wall, walls[SurfaceKind::wall]}}));
}

TEST_F(TouchingHouses, ReceiversStandJustOffTheirTriangle) {
  for_each(SurfaceChoice::all, 1.5, [&](Cell, const TileView& tile, const SurfaceReceiver& r) {
    const package::SurfaceRecord& surface = tile.surface_of(r.triangle);
    EXPECT_EQ(r.normal, surface.normal().direction());
    const Triangle& t = tile.mesh.triangles[r.triangle];
    const Point3f a = tile.mesh.vertices[t.a], b = tile.mesh.vertices[t.b], c = tile.mesh.vertices[t.c];
    const Point3f foot = r.p_cell - surface_offset_m * r.normal;
    EXPECT_NEAR(dot(r.p_cell - a, r.normal), surface_offset_m, place_error_m);
    // Inside: the three triangles that the foot makes with the edges have no more area than the triangle
    const float parts = norm(cross(b - foot, c - foot)) + norm(cross(c - foot, a - foot)) + norm(cross(a - foot, b - foot));
    EXPECT_NEAR(parts, norm(cross(b - a, c - a)), 3 * 30.0F * 2 * place_error_m)
        << "three edges below 30 m, each off by the error of two ends";
  });
}

TEST_F(TouchingHouses, NormalsLookOutward) {
  for_each(SurfaceChoice::all, 2.0, [&](Cell cell, const TileView& tile, const SurfaceReceiver& r) {
    if (tile.surface_of(r.triangle).kind() == SurfaceKind::roof) {
      EXPECT_EQ(r.normal, (Point3f{0.0F, 0.0F, 1.0F}));
      return;
    }
    const bool first = tile.building_number(tile.surface_of(r.triangle)) == 0;
    const Point2d middle = first ? Point2d{15.0, 10.0} : Point2d{39.0, 20.0};
    const Point2d p_grid = package_.grid().corner_of(cell) + Point2d{r.p_cell.x, r.p_cell.y};
    EXPECT_GT(dot(p_grid - middle, Point2d{r.normal.x, r.normal.y}), 0.0);
  });
}

TEST_F(TouchingHouses, EachTriangleHasTheReceiversOfItsArea) {
  for (const double spacing_m : {0.7, 3.0, 100.0}) {
    std::map<std::pair<Cell, std::uint32_t>, std::pair<std::size_t, double>> triangles;
    for_each(SurfaceChoice::all, spacing_m, [&](Cell cell, const TileView&, const SurfaceReceiver& r) {
      auto& [count, area_m2] = triangles[{cell, r.triangle}];
      ++count;
      area_m2 += r.area_m2;
    });
    for (const auto& [triangle, figures] : triangles) {
      const double squares = figures.second / (spacing_m * spacing_m);
      EXPECT_GE(static_cast<double>(figures.first), squares * (1 - 16 * static_cast<double>(float_epsilon)));
      EXPECT_LE(static_cast<double>(figures.first), squares * (1 + 16 * static_cast<double>(float_epsilon)) + 1);
    }
  }
}

TEST_F(TouchingHouses, ThePartyWallIsInside) {
  double party_m2 = 0.0;
  for_each(SurfaceChoice::walls, 0.5, [&](Cell cell, const TileView& tile, const SurfaceReceiver& r) {
    const Point2d p_grid = package_.grid().corner_of(cell) + Point2d{r.p_cell.x, r.p_cell.y};
    const bool first = tile.building_number(tile.surface_of(r.triangle)) == 0;
    const bool on_shared_plane = std::abs(p_grid.x - 27.0) < 0.5 && std::abs(r.normal.x) > 0.5F;
    // The first house's wall is free above 6 m and south of 7 m, the second's north of 17 m
    const bool covered = on_shared_plane && (first ? p_grid.y > 7.0 && r.p_cell.z < 6.0F : p_grid.y < 17.0);
    EXPECT_EQ(r.is_inside_building, covered) << p_grid.x << ", " << p_grid.y << ", " << r.p_cell.z;
    if (r.is_inside_building) party_m2 += r.area_m2;
  });
  // Both sides of 10 m × 6 m, but for receivers whose share of a triangle straddles the edge: half a spacing along it
  EXPECT_NEAR(party_m2, 2 * 60.0, 2 * 0.5 * (6.0 + 10.0 + 6.0));
}

TEST(SurfaceReceivers, APartyWallOnABorderOfTheGridIsInsideFromBothSides) {
  scenes::SceneBuilder builder;
  builder.add_box({{3.0, 3.0}, {20.0, 17.0}}, 0.0, 9.0);
  builder.add_box({{20.0, 3.0}, {37.0, 17.0}}, 0.0, 9.0);
  const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 2);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(builder.city(), grid, folder.path() / "row.farlod", scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "row.farlod");
  for (const Cell cell : {Cell{0, 0}, {1, 0}})
    for (const SurfaceReceiver& r : surface_receivers(package, cell, SurfaceChoice::walls, 1.0)) {
      const bool on_border = std::abs(grid.corner_of(cell).x + r.p_cell.x - 20.0) < 0.5 && std::abs(r.normal.x) > 0.5F;
      EXPECT_EQ(r.is_inside_building, on_border);
    }
}

TEST(SurfaceReceivers, AreNotMoreThanMemoryHolds) {
  scenes::SceneBuilder builder;
  builder.add_box({{10.0, 10.0}, {990.0, 990.0}}, 0.0, 9.0);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(builder.city(), scenes::grid_covering(builder.city(), {}, 1000.0, 1), folder.path() / "hall.farlod",
                    scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "hall.farlod");
  const Cell cell{package.grid().cells.i_begin, package.grid().cells.j_begin};
  EXPECT_GT(surface_receivers(package, cell, SurfaceChoice::all, 10.0).size(), 980U * 980U / 100U);
  EXPECT_THROW((void)surface_receivers(package, cell, SurfaceChoice::all, 0.05), LimitReached);
}

}  // namespace
}  // namespace farlod
