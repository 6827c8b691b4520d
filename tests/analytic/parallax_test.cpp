// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "evaluate/sky_evaluator.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Oracle 10: the error of the paper's map has a closed form where a wall stands on the border of the neighborhood and the
// receiver is half a cell nearer to it than the capture point. The map must show exactly that error, no more and no less.

namespace farlod {
namespace {

struct Parallax {
  double cell_m;
  int neighborhood;
  double H;
};

class PaperMap : public testing::TestWithParam<Parallax> {};

TEST_P(PaperMap, IsWrongByParallaxAsItShouldBe) {
  const auto [c, N, H] = GetParam();
  constexpr double eye_m = 1.5;
  constexpr std::size_t rays = 200000;
  const double D = 0.5 * N * c, middle = 0.5 * c, a = 10 * D;
  scenes::SceneBuilder builder;
  builder.add_wall({middle + D, middle - a}, {middle + D, middle + a}, 0.0, H + eye_m);
  builder.add_box({{middle - 0.05, middle - 0.05}, {middle + 0.05, middle + 0.05}}, 0.0, 0.01);
  const Grid grid = scenes::grid_covering(builder.city(), {}, c, N, 1);
  const scenes::TemporaryFolder folder;
  const FarMapSettings map_settings = scenes::box_maps(256, 256);
  scenes::pack_city(builder.city(), grid, folder.path() / "scene.farlod", map_settings, Assign::clip, {{Cell{0, 0}}});
  const PackageReader package(folder.path() / "scene.farlod");
  // The receiver is in the same cell, as near to the wall as the cell lets it be
  const CellReceivers receiver{{0, 0}, {{0, {std::nextafter(static_cast<float>(c), 0.0F), static_cast<float>(middle), eye_m}}}};
  std::vector<float> map(1), exact(1);
  SkyEvaluator(package, {Engine::rays, SkyWeight::cosine, rays}).evaluate(receiver, map);
  SkyEvaluator(package, {Engine::exact, SkyWeight::cosine, rays}).evaluate(receiver, exact);
  const double sampling = sampling_error(rays, 4 * std::numbers::pi);
  const double map_error = box_map_error(package.box_far_map({0, 0}).shape(), 2 * H / D, steepest_cos);
  EXPECT_NEAR(exact[0], oracles::finite_wall_cos(H, D - c / 2, a, a), sampling);
  EXPECT_NEAR(map[0], oracles::finite_wall_cos(H, D, a, a), sampling + map_error);
}

INSTANTIATE_TEST_SUITE_P(All, PaperMap, testing::Values(Parallax{50, 3, 50}, Parallax{100, 3, 50}));

}  // namespace
}  // namespace farlod
