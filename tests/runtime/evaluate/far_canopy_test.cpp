// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "evaluate/sky_evaluator.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

/// A canopy, 1200 m wide and 6 m up. Whole, it belongs to one cell, far from most that it hangs over; its edges are so far that
/// they hardly rise above the horizontal.
class FarCanopy : public testing::TestWithParam<Assign> {
 protected:
  FarCanopy() : package_(packed()) {}
  [[nodiscard]] PackageReader packed() const {
    scenes::SceneBuilder scene;
    for (const double x : {-601.0, 597.0}) scene.add_box({{x, x}, {x + 4, x + 4}}, 0.0, 3.0);
    scene.add_polygon({{-600, -600, 6}, {600, -600, 6}, {600, 600, 6}});
    const Grid grid = scenes::grid_covering(scene.city(), {}, 50, 1);
    scenes::pack_city(scene.city(), grid, folder_.path() / "canopy.farlod", {}, GetParam(), {{cell_}});
    return PackageReader(folder_.path() / "canopy.farlod");
  }
  [[nodiscard]] SkyAnswers answers() { return SkyAnswers(svf_, low_, high_); }

  const Cell cell_{4, -5};  // as far from all three edges as can be
  scenes::TemporaryFolder folder_;
  PackageReader package_;
  std::vector<float> svf_{0.0F}, low_{0.0F}, high_{0.0F};
};

TEST_P(FarCanopy, HidesTheSkyOverhead) {
  const CellReceivers receiver{cell_, {{0, {25.0F, 25.0F, 1.5F}}}};
  SkyEvaluator(package_, {Engine::exact}).evaluate(receiver, answers());
  const float truth = svf_[0];
  EXPECT_LT(truth, 0.01F);
  for (const Engine engine : {Engine::automatic, Engine::rays}) {
    SkyEvaluator(package_, {engine}).evaluate(receiver, answers());
    EXPECT_NEAR(svf_[0], truth, 0.01F);
    EXPECT_LE(low_[0], truth + 0.01F);
    EXPECT_GE(high_[0], truth - 0.01F);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FarCanopy, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

}  // namespace
}  // namespace farlod
