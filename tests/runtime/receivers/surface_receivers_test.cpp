// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/surface_receivers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "farlod/error.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

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
