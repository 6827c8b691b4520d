// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/whole_city.hpp"

#include <gtest/gtest.h>

#include "scene/near_scene.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

/// A pillar in the middle of each of 7 × 5 cells, as high as its number.
class Pillars : public testing::Test {
 protected:
  static constexpr double cell_m = 20.0;

  Pillars() : grid_(scenes::grid_covering(city(), {}, cell_m, 3, 4)), package_(packed()) {}

  static CityModel city() {
    scenes::SceneBuilder builder;
    for (int j = 0; j < 5; ++j)
      for (int i = -3; i < 4; ++i) {
        const Point2d middle{(i + 0.5) * cell_m, (j + 0.5) * cell_m};
        builder.add_box({middle - Point2d{2.0, 2.0}, middle + Point2d{2.0, 2.0}}, 0.0, height_of({i, j}));
      }
    return builder.city();
  }
  static double height_of(Cell c) { return 10.0 + 7.0 * c.j + c.i; }

  /// Looks down onto a pillar: how far below 100 m is what is met first?
  static double height_seen(const Occluder& occluder, Point3f p_scene) {
    p_scene.z = 100.0F;
    const auto hit = occluder.nearest({p_scene, {0.0F, 0.0F, -1.0F}});
    return hit ? 100.0 - static_cast<double>(hit->distance) : -1.0;
  }

  PackageReader packed() const {
    scenes::pack_city(city(), grid_, folder_.path() / "pillars.farlod", scenes::box_maps(1, 1));
    return PackageReader(folder_.path() / "pillars.farlod");
  }

  /// Four steps of a float of 100 m: Embree divides by an approximate reciprocal where the processor has no AVX-512.
  static constexpr double rounding_m = 3.1e-5;

  /// Off the diagonals of the roofs, and exact in float.
  static constexpr Point3f on_the_pillar{10.5F, 9.25F, 0.0F};

  scenes::TemporaryFolder folder_;
  Grid grid_;
  PackageReader package_;
};

TEST_F(Pillars, TheWholeCityHoldsEachTileInItsPlace) {
  const WholeCity whole(package_);
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n) {
    const Cell cell = grid_.cells.cell_at(n);
    EXPECT_NEAR(height_seen(whole.occluder(), whole.scene_from_cell(on_the_pillar, cell)), height_of(cell), rounding_m)
        << cell.i << ", " << cell.j;
  }
}

TEST_F(Pillars, TheNearSceneHoldsTheNeighborhoodAndNothingElse) {
  for (const Cell cell : {Cell{0, 2}, {-3, 0}, {3, 4}}) {
    const Occluder near = near_scene(package_, cell);
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n) {
      const Cell other = grid_.cells.cell_at(n);
      const Point2d shift = grid_.corner_of(other) - grid_.corner_of(cell);
      const Point3f p_cell = on_the_pillar + Point3f{static_cast<float>(shift.x), static_cast<float>(shift.y), 0.0F};
      const bool is_near = std::abs(other.i - cell.i) <= 1 && std::abs(other.j - cell.j) <= 1;
      EXPECT_NEAR(height_seen(near, p_cell), is_near ? height_of(other) : -1.0, rounding_m) << other.i << ", " << other.j;
    }
  }
}

}  // namespace
}  // namespace farlod
