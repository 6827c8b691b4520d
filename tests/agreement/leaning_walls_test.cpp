// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "package/package_reader.hpp"
#include "receivers/surface_receivers.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Surveyed walls lean out by centimetres: the roof's border is then ahead of them, with no soffit below it.

namespace farlod {
namespace {

/// A house that is wider by `lean_m` to the east at its roof than at its foot, and by `eave_m` to the west.
std::vector<float> svf_of_leaning_wall(double lean_m, double height_m, double eave_m, Engine engine) {
  scenes::SceneBuilder builder;
  const std::vector<Point2d> foot{{6, 6}, {14, 6}, {14, 14}, {6, 14}};
  builder.add_frustum(foot, 0.0, {{6 - eave_m, 6}, {14 + lean_m, 6}, {14 + lean_m, 14}, {6 - eave_m, 14}}, height_m);
  const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 1);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(builder.city(), grid, folder.path() / "house.farlod", {});
  const PackageReader package(folder.path() / "house.farlod");
  SkySettings settings{engine, SkyWeight::cosine, 4000};
  settings.azimuths = 1024;
  const SkyEvaluator evaluator(package, settings);
  std::vector<float> found;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    for (const SurfaceReceiver& r : surface_receivers(package, cell, SurfaceChoice::walls, 1.0)) {
      if (r.normal.x < 0.5F) continue;
      EXPECT_FALSE(r.is_inside_building);
      std::array<float, 1> svf{};
      evaluator.evaluate(CellReceivers{cell, {{0, r.p_cell, r.normal}}}, svf);
      found.push_back(svf[0]);
    }
  }
  return found;
}

struct Lean {
  double lean_m, height_m;
};
class LeaningWalls : public testing::TestWithParam<Lean> {};

TEST_P(LeaningWalls, SeeTheSkyOfATiltedPlaneInEveryEngine) {
  const auto [lean_m, height_m] = GetParam();
  // Nothing but the wall and the ground: the sky above a plane whose normal is tilted below the horizontal
  const double known = 0.5 * (1.0 - lean_m / std::hypot(lean_m, height_m));
  // With the eave, sky may be seen below the house: its edges are not grounded
  for (const double eave_m : {0.0, 0.5})
    for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
      const std::vector<float> svf = svf_of_leaning_wall(lean_m, height_m, eave_m, engine);
      ASSERT_GE(svf.size(), static_cast<std::size_t>(8 * height_m));
      // 4,000 rays, and the centimetre by which a receiver stands before its wall, seen from the roof's border and from the
      // ground
      for (const float s : svf) EXPECT_NEAR(s, known, 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(Metres, LeaningWalls,
                         testing::Values(Lean{0.0, 5.0}, Lean{0.008, 5.0}, Lean{0.02, 5.0}, Lean{0.045, 5.0}, Lean{0.2, 5.0},
                                         Lean{0.04, 15.0}, Lean{0.1, 15.0}));

}  // namespace
}  // namespace farlod
