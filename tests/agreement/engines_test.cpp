// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "scene/ray_scenes.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/agreement/ray_oracle.hpp"
#include "tests/oracles/far_view.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

Point3f rounded(const Point3d& d) { return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}; }

/// A town, and what rays meet of all of it.
struct TownOfRays {
  CityModel city;
  Grid grid;
  scenes::TemporaryFolder folder;
  PackageReader package;
  WholeCity whole{package};

  TownOfRays(int neighborhood, const FarMapSettings& maps, Assign assign = Assign::clip, bool overhangs = true)
      : city(scenes::generated_town(CitySettings{.size_m = 500, .lod = 2, .overhangs = overhangs})),
        grid(scenes::grid_covering(city, Angle::degrees(23.0), 50.0, neighborhood)),
        package(packed(maps, assign)) {}

 private:
  [[nodiscard]] PackageReader packed(const FarMapSettings& maps, Assign assign) const {
    scenes::pack_city(city, grid, folder.path() / "town.farlod", maps, assign);
    return PackageReader(folder.path() / "town.farlod");
  }
};

TEST(Agreement, ANeighborhoodThatCoversTheCityIsTheCity) {
  const TownOfRays town(41, scenes::box_maps(8, 8));
  ASSERT_LE(town.grid.cells.width(), 20);
  RandomSky random;
  constexpr int receivers = 200, rays_each = 5000;
  int differences = 0;
  for (int n = 0; n < receivers; ++n) {
    const CellReceivers r = random.receiver(town.package);
    const Occluder near = near_scene(town.package, r.cell);
    ASSERT_EQ(near.triangle_count(), town.whole.occluder().triangle_count());
    const Point3f p = r.receivers[0].p_cell, p_whole = town.whole.scene_from_cell(p, r.cell);
    for (int k = 0; k < rays_each; ++k) {
      const Point3f d = rounded(random.direction_above_horizon());
      differences += near.blocks({p, d}) != town.whole.occluder().blocks({p_whole, d}) ? 1 : 0;
    }
  }
  // The two frames round differently: a ray that grazes an edge may pass it on either side, but no more than one in 100,000
  EXPECT_LE(differences, receivers * rays_each / 100000);
}

class NearAndFar : public testing::TestWithParam<Assign> {};

TEST_P(NearAndFar, TogetherAreTheCitySeenFromTheCapturePoint) {
  const FarMapSettings settings = scenes::box_maps(16, 16);
  const BoxMapSettings& map = settings.box;
  const TownOfRays town(3, settings, GetParam());
  int rays = 0, differences = 0, far_alone = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(town.grid.cells.size()); ++n) {
    const Cell cell = town.grid.cells.cell_at(n);
    const auto& record = *town.package.tile(cell).cell;
    const Point3f p{record.capture_x_m, record.capture_y_m, record.capture_z_m};
    const Occluder near = near_scene(town.package, cell);
    const BoxFarMap far = town.package.box_far_map(cell);
    for (std::uint32_t row = 0; row < map.rows && record.far_map_top > 0.0F; ++row)
      for (std::uint32_t column = 0; column < 4 * map.side_columns; ++column) {
        const Point3d d = far.shape().direction_of({column, row});
        const bool is_near = near.blocks({p, rounded(d)}), is_far = far.blocks(d);
        differences +=
            (is_near || is_far) != town.whole.occluder().blocks({town.whole.scene_from_cell(p, cell), rounded(d)}) ? 1 : 0;
        far_alone += is_far && !is_near ? 1 : 0;
        ++rays;
      }
  }
  EXPECT_GT(far_alone, 1000);
  EXPECT_LE(differences, rays / 100000);
}

TEST_P(NearAndFar, AreNeverCertainOfWhatIsNotSo) {
  // FarView takes all of the far city for grounded
  const TownOfRays town(3, {}, GetParam(), false);
  RandomSky random;
  constexpr int receivers = 200, rays_each = 5000;
  int differences = 0, certain = 0, blocked_afar = 0;
  for (int n = 0; n < receivers; ++n) {
    const CellReceivers r = random.receiver(town.package);
    const FarHorizon far = town.package.far_horizon(r.cell);
    const Occluder near = near_scene(town.package, r.cell);
    const Point3f p = r.receivers[0].p_cell, p_whole = town.whole.scene_from_cell(p, r.cell);
    const FarView view(far, p);
    for (int k = 0; k < rays_each; ++k) {
      const Point3d direction = random.direction_above_horizon();
      const FarVerdict verdict = view.verdict(direction);
      if (verdict != FarVerdict::free && verdict != FarVerdict::blocked) continue;
      ++certain;
      const Point3f d = rounded(direction);
      const bool is_blocked = verdict == FarVerdict::blocked || near.blocks({p, d});
      differences += is_blocked != town.whole.occluder().blocks({p_whole, d}) ? 1 : 0;
      blocked_afar += verdict == FarVerdict::blocked && !near.blocks({p, d}) ? 1 : 0;
    }
  }
  EXPECT_LE(differences, certain / 100000);
  // The comparison must have had something to compare
  EXPECT_GT(certain, receivers * rays_each * 3 / 4);
  EXPECT_GT(blocked_afar, 1000);
}

INSTANTIATE_TEST_SUITE_P(All, NearAndFar, testing::Values(Assign::clip, Assign::whole));

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
  const TownOfRays town(3, scenes::box_maps(8, 8));
  const RayOracle oracle(town.city);
  RandomSky random;
  int away_from_edges = 0, blocked = 0;
  constexpr int rays = 2000;
  for (int n = 0; n < rays; ++n) {
    const CellReceivers r = random.receiver(town.package);
    const Point3d d_city = random.direction_above_horizon();
    const Point3d d_grid = town.grid.rotation.grid_from_city(d_city);
    const Point3f p = r.receivers[0].p_cell;
    const Point2d corner = town.grid.corner_of(r.cell);
    const Point3d p_city =
        town.grid.rotation.city_from_grid(Point3d{corner.x + p.x, corner.y + p.y, p.z + town.package.manifest().height_origin_m});
    if (!is_away_from_edges(oracle, p_city, d_city)) continue;
    ++away_from_edges;
    const bool is_blocked = oracle.blocks(p_city, d_city);
    blocked += is_blocked ? 1 : 0;
    EXPECT_EQ(town.whole.occluder().blocks({town.whole.scene_from_cell(p, r.cell), rounded(d_grid)}), is_blocked) << "ray " << n;
  }
  // The comparison must have had something to compare: most rays, of both kinds
  EXPECT_GT(away_from_edges, rays * 95 / 100);
  EXPECT_GT(blocked, rays / 5);
  EXPECT_LT(blocked, rays * 4 / 5);
}

}  // namespace
}  // namespace farlod
