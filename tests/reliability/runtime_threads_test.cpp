// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stop_token>
#include <thread>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/scenes/temporary_folder.hpp"

// What users of the library may do at once, on packages that are there: no farlod-pack is built, so that ThreadSanitizer sees the
// runtime after minutes.

namespace farlod {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t threads_at_once = 4;
constexpr std::array engines{Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};

/// Calls `work` with the numbers of some threads, which begin together.
void at_once(const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> waiting = threads_at_once;
  std::vector<std::jthread> threads;
  for (std::size_t n = 0; n < threads_at_once; ++n)
    threads.emplace_back([&, n] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      work(n);
    });
}

class RuntimeThreads : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] static fs::path folder() {
    return fs::path(FARLOD_GOLDEN_DIR) / (std::string("version_8_") + GetParam() + ".farlod");
  }
  [[nodiscard]] static std::vector<float> answers_of(const Package& package, Engine engine, std::stop_token stop = {}) {
    const Box2d outline = package.description().outline_projected;
    std::vector<double> x, y;
    for (double e = outline.low.x + 5.0; e < outline.high.x; e += 20.0)
      for (double n = outline.low.y + 5.0; n < outline.high.y; n += 20.0) {
        x.push_back(e);
        y.push_back(n);
      }
    EvaluationSettings settings;
    settings.engine = engine;
    settings.rays = 145;
    RunSettings run;
    run.threads = 2;
    run.stop = std::move(stop);
    std::vector<float> svf = evaluate_points(package, {x, y}, {}, settings, run).svf;
    for (float& value : svf) value = value == value ? value : -1.0F;  // no data, which is not equal to itself
    return svf;
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, RuntimeThreads, testing::Values("horizon", "box"), [](const auto& test) { return test.param; });

TEST_P(RuntimeThreads, RunsOfOnePackageAnswerAsAlone) {
  std::array<std::vector<float>, engines.size()> alone;
  for (std::size_t n = 0; n < engines.size(); ++n) alone[n] = answers_of(Package(folder()), engines[n]);
  const Package package(folder());
  at_once([&](std::size_t n) { EXPECT_EQ(answers_of(package, engines[n]), alone[n]) << n; });
}

TEST_P(RuntimeThreads, InspectionsAndRunsShareOnePackage) {
  const Package package(folder());
  const CellRectangle cells = inventory_of(package).cells;
  const CellPlace cell{cells.i_begin, cells.j_begin};
  const std::array<std::function<void()>, threads_at_once> works{
      [&] { EXPECT_TRUE(check_package(package).damage.empty()); },
      [&] { EXPECT_FALSE(geometry_of(package, cells).empty() || !far_view_of(package, cell)); },
      [&] { EXPECT_GT(evaluate_raster(package, plan_raster(package, 20.0)).summary.receivers, 0U); },
      [&] {
        EXPECT_FALSE(evaluate_surfaces(package, {SurfaceChoice::all, 10.0}).buildings.empty());
      }};
  at_once([&](std::size_t n) { works[n](); });
}

TEST_P(RuntimeThreads, PackagesAreOpenedAndClosedAtOnce) {
  const std::vector<float> alone = answers_of(Package(folder()), Engine::automatic);
  at_once([&](std::size_t) {
    for (int again = 0; again < 3; ++again) {
      Package package(folder());
      EXPECT_EQ(answers_of(package, Engine::automatic), alone);
      package.close();
    }
  });
}

TEST_P(RuntimeThreads, AllMeetTheSameDamage) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "what ThreadSanitizer puts in the place of pthread_once waits for ever after an exception";
#endif
  const scenes::TemporaryFolder temporary;
  const fs::path copy = temporary.path() / "damaged.farlod";
  fs::copy(folder(), copy, fs::copy_options::recursive);
  for (const auto& entry : fs::recursive_directory_iterator(copy))
    if (entry.path().filename() == "tiles.bin") std::ofstream(entry.path(), std::ios::app) << '\n';
  const Package package(copy);
  at_once([&](std::size_t n) { EXPECT_THROW((void)answers_of(package, engines[n]), PackageDamaged); });
}

TEST_P(RuntimeThreads, OneRunIsCancelledAndTheOthersAnswer) {
  const Package package(folder());
  const std::vector<float> alone = answers_of(package, Engine::exact);
  std::stop_source stop;
  stop.request_stop();
  at_once([&](std::size_t n) {
    if (n == 0)
      EXPECT_THROW((void)answers_of(package, Engine::exact, stop.get_token()), Cancelled);
    else
      EXPECT_EQ(answers_of(package, Engine::exact), alone);
  });
}

}  // namespace
}  // namespace farlod
