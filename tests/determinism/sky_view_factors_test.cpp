// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <thread>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/raster_receivers.hpp"
#include "tests/determinism/crooked_town.hpp"
#include "tests/determinism/threads.hpp"
#include "tests/scenes/packed_once.hpp"

namespace farlod {
namespace {

struct Way {
  const char* name;
  Engine engine;
  FarMapKind kind;
  std::optional<double> allowed_error = std::nullopt;
  DirectionSet directions = DirectionSet::partition;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

class SkyViewFactors : public testing::TestWithParam<Way> {
 protected:
  SkyViewFactors()
      : path_(path_of_packed()),
        package_(path_),
        plan_(plan_raster(package_.manifest(), 3.0, std::nullopt)),
        raster_(package_.manifest(), plan_) {}

  static std::filesystem::path path_of_packed() {
    const FarMapKind kind = GetParam().kind;
    const auto pack = [kind](const std::filesystem::path& folder) {
      scenes::pack_city(crooked_town(), crooked_grid(), folder / "town.farlod", scenes::small_maps(kind));
      return true;
    };
    return scenes::packed_once({std::string("crooked_town_") + scenes::name_of(kind), "", scenes::this_program()}, pack) /
           "town.farlod";
  }
  [[nodiscard]] SkySettings settings() const {
    return {GetParam().engine, SkyWeight::cosine, 145, GetParam().allowed_error, GetParam().directions, 64};
  }
  [[nodiscard]] CellReceivers receivers_of(Cell cell) const { return raster_.in_cell(package_, cell, HeightAbove::ground, 1.5F); }

  /// The whole raster, cells in parallel; bits, so that no data equals no data.
  std::vector<std::uint32_t> raster_with(std::size_t threads, bool backwards = false) const {
    std::vector<float> svf(plan_.columns * plan_.rows, std::numeric_limits<float>::quiet_NaN());
    const PackageReader opened_anew(path_);
    const SkyEvaluator evaluator(opened_anew, settings());
    std::vector<Cell> cells = raster_.cells();
    if (backwards) std::reverse(cells.begin(), cells.end());
    with_threads(threads, [&] {
      oneapi::tbb::parallel_for(std::size_t{0}, cells.size(),
                                [&](std::size_t n) { evaluator.evaluate(receivers_of(cells[n]), svf); });
    });
    EXPECT_TRUE(std::any_of(svf.begin(), svf.end(), [](float x) { return x < 0.9F; })) << "the town hides too little to tell";
    std::vector<std::uint32_t> bits;
    for (const float x : svf) bits.push_back(std::bit_cast<std::uint32_t>(x));
    return bits;
  }

  std::filesystem::path path_;
  PackageReader package_;
  RasterPlan plan_;
  RasterReceivers raster_;
};

TEST_P(SkyViewFactors, DoNotDependOnTheNumberOfThreads) {
  const std::vector<std::uint32_t> alone = raster_with(1);
  for (int n = 0; n < repeats; ++n) EXPECT_TRUE(raster_with(many_threads) == alone);
}

TEST_P(SkyViewFactors, DoNotDependOnTheOrderOfCells) { EXPECT_TRUE(raster_with(1, true) == raster_with(2)); }

/// Threads of a user of the library, each with all cells in an order of its own. Between them stands nothing but the evaluator:
/// a race is seen by ThreadSanitizer, which oneTBB, where it is not compiled for it, hides.
TEST_P(SkyViewFactors, DoNotDependOnThreadsThatShareAnEvaluator) {
  const std::vector<std::uint32_t> alone = raster_with(1);
  const SkyEvaluator evaluator(package_, settings());
  const std::vector<Cell> cells = raster_.cells();
  std::vector<std::vector<float>> svf(3, std::vector<float>(alone.size(), std::numeric_limits<float>::quiet_NaN()));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < svf.size(); ++t)
    threads.emplace_back([&, t] {
      for (std::size_t n = 0; n < cells.size(); ++n)
        evaluator.evaluate(receivers_of(cells[(n + t * cells.size() / svf.size()) % cells.size()]), svf[t]);
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& answers : svf)
    for (std::size_t n = 0; n < alone.size(); ++n) ASSERT_EQ(std::bit_cast<std::uint32_t>(answers[n]), alone[n]) << "pixel " << n;
}

TEST_P(SkyViewFactors, DoNotDependOnWhatElseIsAsked) {
  const SkyEvaluator evaluator(package_, settings());
  const std::vector<Cell> cells = raster_.cells();
  for (const std::size_t middle : {cells.size() / 2, cells.size() / 3}) {
    CellReceivers together = receivers_of(cells[middle]);
    for (std::size_t n = 0; n < together.receivers.size(); ++n) together.receivers[n].index = n;
    std::vector<float> svf(together.receivers.size(), -1.0F);
    evaluator.evaluate(together, svf);
    for (const Receiver& r : together.receivers) {
      std::vector<float> alone(1, -1.0F);
      evaluator.evaluate({together.cell, {{0, r.p_cell, r.normal}}}, alone);
      // Bounds are those of a packet, and an allowed error keeps answers within them
      if (const std::optional<double> error = GetParam().allowed_error)
        EXPECT_NEAR(alone[0], svf[r.index], *error) << "receiver " << r.index;
      else
        EXPECT_EQ(alone[0], svf[r.index]) << "receiver " << r.index;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, SkyViewFactors,
                         testing::Values(Way{"RaysBox", Engine::rays, FarMapKind::box},
                                         Way{"RaysHorizon", Engine::rays, FarMapKind::horizon},
                                         Way{"RaysHorizonRetraced", Engine::rays, FarMapKind::horizon, 0.01},
                                         Way{"FibonacciRays", Engine::rays, FarMapKind::horizon, 0.01, DirectionSet::fibonacci},
                                         Way{"AutomaticHorizon", Engine::automatic, FarMapKind::horizon},
                                         Way{"AutomaticHorizonRetraced", Engine::automatic, FarMapKind::horizon, 0.01},
                                         Way{"HorizonOnly", Engine::horizon, FarMapKind::horizon},
                                         Way{"Exact", Engine::exact, FarMapKind::horizon}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlod
