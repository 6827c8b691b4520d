// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <stop_token>

#include "farlod/error.hpp"
#include "farlod/raster.hpp"
#include "tests/counted/steps.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::library {
namespace {

/// What a run may still do after it was asked to stop, in steps of the loops over receivers, directions and rays: some for each
/// receiver of a cell, which take milliseconds. Those that are longer look for the stop in each of their rounds.
constexpr std::uint64_t most_steps = 3'000'000;

/// A town whose rasters take millions of steps in each engine.
class CancelledTown : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<scenes::TemporaryFolder>();
    CitySettings settings{.size_m = 300.0, .seed = 7};
    const CityModel city = scenes::generated_town(settings);
    scenes::pack_city(city, scenes::grid_covering(city, {}, 100.0, 3), folder_->path() / "town.farlod",
                      scenes::small_maps(FarMapKind::horizon));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// Of a run that is asked to stop in the midst of its work: the steps that it takes from then on.
  static std::uint64_t steps_after(std::uint64_t at, double step_m, const EvaluationSettings& settings) {
    const Package package(folder_->path() / "town.farlod");
    const RasterPlan plan = plan_raster(package, step_m);
    std::stop_source stop;
    RunSettings run;
    run.threads = 1;
    run.stop = stop.get_token();
    const CountedSteps steps(at, [&] { stop.request_stop(); });
    EXPECT_THROW((void)evaluate_raster(
                     package, plan, {}, settings, [](const RasterTile&) {}, run),
                 Cancelled);
    return steps.count() - at;
  }
  static inline std::unique_ptr<scenes::TemporaryFolder> folder_;
};

class Cancelling : public CancelledTown, public testing::WithParamInterface<Engine> {};

TEST_P(Cancelling, EndsWithinSomeSteps) {
  EvaluationSettings settings;
  settings.engine = GetParam();
  // Horizons take few steps for each of their receivers
  const double step_m = GetParam() == Engine::automatic ? 0.08 : 0.5;
  for (const std::uint64_t at : {1'000U, 100'000U, 1'000'000U, 3'000'000U}) {
    EXPECT_LE(steps_after(at, step_m, settings), most_steps) << "asked at step " << at;
  }
}

TEST_F(CancelledTown, EndsAmongTheRaysOfAReceiver) {
  EvaluationSettings settings;
  settings.engine = Engine::exact;
  settings.rays = 500'000;
  for (const std::uint64_t at : {100'000U, 10'000'000U}) {
    EXPECT_LE(steps_after(at, 1.0, settings), most_steps) << "asked at step " << at;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, Cancelling, testing::Values(Engine::automatic, Engine::rays, Engine::exact),
                         [](const auto& engine) {
                           return engine.param == Engine::automatic ? "Automatic"
                                  : engine.param == Engine::rays    ? "Rays"
                                                                    : "Exact";
                         });

}  // namespace
}  // namespace farlod::library
