// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::library {
namespace {

using Clock = std::chrono::steady_clock;

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Threads, TwoWithOnePackage) {
  const PackedSample sample;
  const Package package(sample.folder());
  const RasterPlan plan = plan_raster(package, 2.0);
  const Raster alone = evaluate_raster(package, plan);
  const SurfaceMeans alone_surfaces = evaluate_surfaces(package, {});
  std::vector<Raster> rasters(2);
  SurfaceMeans surfaces;
  {
    const std::jthread first([&] { rasters[0] = evaluate_raster(package, plan); });
    const std::jthread second([&] { rasters[1] = evaluate_raster(package, plan); });
    const std::jthread third([&] { surfaces = evaluate_surfaces(package, {}); });
  }
  for (const Raster& raster : rasters) EXPECT_TRUE(same_bytes(raster.svf, alone.svf));
  ASSERT_EQ(surfaces.surfaces.size(), alone_surfaces.surfaces.size());
  for (std::size_t n = 0; n < surfaces.surfaces.size(); ++n)
    EXPECT_EQ(surfaces.surfaces[n].svf_mean, alone_surfaces.surfaces[n].svf_mean);
}

TEST(Threads, FourPackagesInOneProcess) {
  const PackedSample samples[]{PackedSample(), PackedSample(FarMapKind::box), PackedSample(), PackedSample()};
  std::vector<Raster> alone, together(4);
  for (const PackedSample& sample : samples) {
    const Package package(sample.folder());
    alone.push_back(evaluate_raster(package, plan_raster(package, 4.0)));
  }
  {
    std::vector<std::jthread> threads;
    for (std::size_t n = 0; n < 4; ++n)
      threads.emplace_back([&, n] {
        RunSettings run;
        run.threads = n + 1;
        const Package package(samples[n].folder());
        together[n] = evaluate_raster(package, plan_raster(package, 4.0), {}, {}, run);
      });
  }
  for (std::size_t n = 0; n < 4; ++n) EXPECT_TRUE(same_bytes(together[n].svf, alone[n].svf)) << n;
}

TEST(Threads, PackingBesideEvaluating) {
  const PackedSample sample;
  const Package package(sample.folder());
  const Raster alone = evaluate_raster(package, plan_raster(package, 4.0));
  Raster beside;
  {
    const std::jthread evaluating([&] { beside = evaluate_raster(package, plan_raster(package, 4.0)); });
    const std::jthread packing([] { const PackedSample another; });
  }
  EXPECT_TRUE(same_bytes(beside.svf, alone.svf));
}

/// A small town, packed fast also by ThreadSanitizer. Its rasters are so fine that they take much longer than a tenth of a second
/// in each engine.
class CancelledTown : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<scenes::TemporaryFolder>();
    CitySettings settings;
    settings.size_m = 300.0;
    settings.seed = 7;
    const CityModel city = scenes::generated_town(settings);
    scenes::pack_city(city, scenes::grid_covering(city, {}, 100.0, 3), folder_->path() / "town.farlod",
                      scenes::small_maps(FarMapKind::horizon));
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static inline std::unique_ptr<scenes::TemporaryFolder> folder_;
};

class Cancelling : public CancelledTown, public testing::WithParamInterface<Engine> {};

// Sanitizers take up to ten times as long
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr auto longest_wait = std::chrono::milliseconds(1000);
#else
constexpr auto longest_wait = std::chrono::milliseconds(100);
#endif

/// Runs on a thread, and asks it to stop after a while.
std::chrono::duration<double> wait_after_stop(std::chrono::milliseconds after, const std::function<void(std::stop_token)>& run) {
  std::stop_source stop;
  std::exception_ptr ended_by;
  Clock::time_point ended;
  std::jthread thread([&] {
    try {
      run(stop.get_token());
    } catch (...) {
      ended_by = std::current_exception();
    }
    ended = Clock::now();
  });
  std::this_thread::sleep_for(after);
  const Clock::time_point asked = Clock::now();
  stop.request_stop();
  thread.join();
  EXPECT_TRUE(ended_by) << "the run came to its end before it was asked to stop";
  try {
    if (ended_by) std::rethrow_exception(ended_by);
  } catch (const Cancelled&) {  // as it should be
  }
  return ended - asked;
}

/// The least of some runs: other processes of the machine only make it longer.
std::chrono::duration<double> least_wait_after_stop(std::chrono::milliseconds after,
                                                    const std::function<void(std::stop_token)>& run) {
  constexpr int most_runs = 5;
  std::chrono::duration<double> least = wait_after_stop(after, run);
  for (int more = 1; more < most_runs && least > longest_wait; ++more) least = std::min(least, wait_after_stop(after, run));
  return least;
}

TEST_P(Cancelling, EndsWithinATenthOfASecond) {
  const Package package(folder_->path() / "town.farlod");
  const RasterPlan plan = plan_raster(package, 0.08);
  EvaluationSettings settings;
  settings.engine = GetParam();
  for (const int after_ms : {20, 100, 300}) {
    const auto waited = least_wait_after_stop(std::chrono::milliseconds(after_ms), [&](const std::stop_token& stop) {
      RunSettings run;
      run.stop = stop;
      (void)evaluate_raster(
          package, plan, {}, settings, [](const RasterTile&) {}, run);
    });
    EXPECT_LE(waited, longest_wait) << "asked after " << after_ms << " ms";
  }
}

/// Sixteen receivers have so many rays together that they take longer than a run may take to end.
TEST_F(CancelledTown, EndsAmongTheRaysOfAReceiver) {
  const Package package(folder_->path() / "town.farlod");
  EvaluationSettings settings;
  settings.engine = Engine::exact;
  settings.rays = 500'000;
  for (const int after_ms : {100, 300}) {
    const auto waited = least_wait_after_stop(std::chrono::milliseconds(after_ms), [&](const std::stop_token& stop) {
      RunSettings run;
      run.stop = stop;
      (void)evaluate_raster(package, plan_raster(package, 1.0), {}, settings, run);
    });
    EXPECT_LE(waited, longest_wait) << "asked after " << after_ms << " ms";
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
