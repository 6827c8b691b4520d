// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "scene/whole_city.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/agreement/ray_oracle.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

/// A ray counts as away from edges when turning it by this much, four ways, changes nothing. Vertices are rounded by at most 15
/// µm in a scene of 500 m, seen from no nearer than some decimetres: below this angle.
constexpr double edge_angle_rad = 2e-4;

std::array<Point3d, 4> turned_a_little(const Point3d& d) {
  const Point3d u = normalized(cross(d, std::abs(d.z) < 0.9 ? Point3d{0, 0, 1} : Point3d{1, 0, 0})), v = cross(d, u);
  return {d + edge_angle_rad * u, d - edge_angle_rad * u, d + edge_angle_rad * v, d - edge_angle_rad * v};
}

bool is_away_from_edges(const RayOracle& oracle, const Point3d& origin, const Point3d& d) {
  const bool blocked = oracle.blocks(origin, d);
  for (const Point3d& turned : turned_a_little(d))
    if (oracle.blocks(origin, turned) != blocked) return false;
  return true;
}

TEST(Agreement, CgalAndEmbreeSeeTheSameTownRayForRay) {
  CitySettings settings;
  settings.size_m = 500;
  settings.lod = 2;
  settings.overhangs = true;
  const CityModel city = scenes::generated_town(settings);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(23.0), 50.0, 3);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(city, grid, folder.path() / "town.farlod", scenes::box_maps(8, 8));
  const PackageReader package(folder.path() / "town.farlod");
  const WholeCity whole(package);
  const RayOracle oracle(city);
  RandomSky random;
  int away_from_edges = 0, blocked = 0;
  constexpr int rays = 2000;
  for (int n = 0; n < rays; ++n) {
    const CellReceivers r = random.receiver(package);
    const Point3d d_city = random.direction_above_horizon();
    const Point3d d_grid = grid.rotation.grid_from_city(d_city);
    const Point3f p = r.receivers[0].p_cell;
    const Point2d corner = grid.corner_of(r.cell);
    const Point3d p_city =
        grid.rotation.city_from_grid(Point3d{corner.x + p.x, corner.y + p.y, p.z + package.manifest().height_origin_m});
    if (!is_away_from_edges(oracle, p_city, d_city)) continue;
    ++away_from_edges;
    const bool is_blocked = oracle.blocks(p_city, d_city);
    blocked += is_blocked ? 1 : 0;
    EXPECT_EQ(
        whole.occluder().blocks({whole.scene_from_cell(p, r.cell),
                                 {static_cast<float>(d_grid.x), static_cast<float>(d_grid.y), static_cast<float>(d_grid.z)}}),
        is_blocked)
        << "ray " << n;
  }
  // The comparison must have had something to compare: most rays, of both kinds
  EXPECT_GT(away_from_edges, rays * 95 / 100);
  EXPECT_GT(blocked, rays / 5);
  EXPECT_LT(blocked, rays * 4 / 5);
}

}  // namespace
}  // namespace farlod
