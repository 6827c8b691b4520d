// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "evaluate/error_budget.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string name_of(EvaluationMethod method) {
  switch (method) {
    case EvaluationMethod::horizons:
      return "horizons";
    case EvaluationMethod::rays_against_horizons:
      return "rays_against_horizons";
    case EvaluationMethod::near_scene_and_box:
      return "near_scene_and_box";
    case EvaluationMethod::near_scene_alone:
      return "near_scene_alone";
    case EvaluationMethod::whole_city:
      return "whole_city";
    case EvaluationMethod::pixels_and_whole_city:
      return "pixels_and_whole_city";
  }
  return "";
}

using Row = std::array<std::string, 7>;

/// Engine and methods of each row of the table in docs/stages/evaluate.md.
std::vector<Row> documented_rows() {
  static const std::regex row(
      "^\\| `(\\w+)`[^|]*\\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\|$");
  std::ifstream file(FARLOD_SOURCE_DIR "/docs/stages/evaluate.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::smatch cells;
    if (std::regex_match(line, cells, row))
      rows.push_back({cells[1], cells[2], cells[3], cells[4], cells[5], cells[6], cells[7]});
  }
  return rows;
}

TEST(EvaluationMethod, FollowsTheDocumentedTable) {
  std::vector<Row> rows;
  for (const auto& [name, engine] : {std::pair("auto", Engine::automatic),
                                     {"horizon", Engine::horizon},
                                     {"rays", Engine::rays},
                                     {"exact", Engine::exact},
                                     {"near_only", Engine::near_only}})
    rows.push_back({name, name_of(method_of(engine, FarMapOfCell::horizon)), name_of(method_of(engine, FarMapOfCell::box)),
                    name_of(method_of(engine, FarMapOfCell::missing)), name_of(method_of(engine, FarMapOfCell::needless)),
                    name_of(method_of(engine, FarMapOfCell::outside_of_grid)),
                    name_of(method_of(engine, FarMapOfCell::all_is_near))});
  EXPECT_EQ(rows, documented_rows());
}

/// Whatever the engine is called, the sampling error is that of what answers.
TEST(EvaluationMethod, SaysWhoseSamplingErrorCounts) {
  // Either may be the larger one
  for (const auto& [rays, azimuths] : {std::pair<std::size_t, std::size_t>{100, 1000}, {100'000, 10}}) {
    const auto error = [&, rays = rays, azimuths = azimuths](Engine engine, FarMapOfCell far_map,
                                                             std::optional<double> allowed_error = {}) {
      return sampling_error_of({engine, SkyWeight::cosine, rays, allowed_error, DirectionSet::partition, azimuths}, far_map);
    };
    const double of_rays = sampling_error(rays), of_azimuths = azimuth_error(azimuths), larger = std::max(of_rays, of_azimuths);
    for (const Engine engine : {Engine::automatic, Engine::horizon}) EXPECT_EQ(error(engine, FarMapOfCell::horizon), of_azimuths);
    EXPECT_EQ(error(Engine::horizon, FarMapOfCell::horizon, 0.01), 0.0) << "bounds keep it";
    EXPECT_EQ(error(Engine::rays, FarMapOfCell::horizon), of_rays);
    for (const Engine engine : {Engine::automatic, Engine::horizon, Engine::rays, Engine::exact, Engine::near_only})
      for (const FarMapOfCell far_map : {FarMapOfCell::box, FarMapOfCell::outside_of_grid})
        EXPECT_EQ(error(engine, far_map), of_rays);
    for (const Engine engine : {Engine::automatic, Engine::horizon})
      EXPECT_EQ(error(engine, FarMapOfCell::all_is_near), of_azimuths);
    for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact})
      EXPECT_EQ(error(engine, FarMapOfCell::missing), of_rays);
    EXPECT_EQ(error(Engine::automatic, FarMapOfCell::needless), larger);
  }
}

TEST(ErrorBudget, AsManyRaysAsItTakesAndNoMore) {
  for (const double error : {0.05, 0.01, 0.005, 0.001, 0.0001}) {
    const std::size_t rays = rays_for_sampling_error(error);
    EXPECT_LE(sampling_error(rays), error);
    EXPECT_GT(sampling_error(rays - 1), error);
  }
}

TEST(ErrorBudget, AsManyAzimuthsAsItTakesAndNoMore) {
  for (const double error : {0.05, 0.011, 0.007, 0.0013, 0.0001}) {
    const std::size_t azimuths = azimuths_for_error(error);
    EXPECT_LE(azimuth_error(azimuths), error);
    EXPECT_GT(azimuth_error(azimuths - 1), error);
  }
}

// Receivers of the generated city of docs/validation.md: the largest errors seen
TEST(ErrorBudget, CoversWhatWasMeasured) {
  EXPECT_GE(sampling_error(500), 0.0246);
  EXPECT_GE(sampling_error(1000), 0.0107);
  EXPECT_GE(sampling_error(4000), 0.0047);
}

TEST(ErrorSummary, CountsWhatItSays) {
  // Binary fractions, so that sums are exact
  const std::vector<double> exact{0.5, 0.5, 0.5, 0.5}, answers{0.5, 0.75, 0.375, 0.625};
  const ErrorSummary summary = summarize_errors(answers, exact);
  EXPECT_EQ(summary.count, 4U);
  EXPECT_EQ(summary.mean_abs_error, 0.125);
  EXPECT_EQ(summary.max_abs_error, 0.25);
  EXPECT_EQ(summary.p99_abs_error, 0.25);
  EXPECT_EQ(summary.bias, 0.0625);
}

TEST(ErrorSummary, BiasIsAnswerMinusExact) {
  EXPECT_EQ(summarize_errors(std::vector{0.75}, std::vector{0.5}).bias, 0.25);
  EXPECT_EQ(summarize_errors(std::vector{0.25}, std::vector{0.5}).bias, -0.25);
}

TEST(ErrorSummary, ThePercentileIsTheSmallestErrorThat99PercentDoNotExceed) {
  std::vector<double> answers, exact(200, 0.0);
  for (int n = 1; n <= 200; ++n) answers.push_back(n / 256.0);
  std::reverse(answers.begin(), answers.end());
  EXPECT_EQ(summarize_errors(answers, exact).p99_abs_error, 198 / 256.0);
  EXPECT_EQ(summarize_errors(std::span(answers).first(1), std::span(exact).first(1)).p99_abs_error, 200 / 256.0);
}

TEST(ErrorSummary, OfNothingIsNothing) {
  const ErrorSummary summary = summarize_errors({}, {});
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.mean_abs_error, 0.0);
}

TEST(ChooseSome, AscendsWithoutRepeats) {
  for (const std::size_t size : {2U, 10U, 1000U, 100000U})
    for (const std::size_t count : {std::size_t{1}, size / 2, size - 1}) {
      const std::vector<std::size_t> chosen = choose_some(size, count);
      EXPECT_EQ(chosen.size(), count);
      EXPECT_TRUE(std::adjacent_find(chosen.begin(), chosen.end(), std::greater_equal<>()) == chosen.end());
      EXPECT_LT(chosen.back(), size);
      EXPECT_EQ(chosen, choose_some(size, count));
    }
}

TEST(ChooseSome, TakesAllWhenThereAreNoMore) {
  EXPECT_THAT(choose_some(3, 3), ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(choose_some(3, 300), ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(choose_some(0, 5), IsEmpty());
  EXPECT_THAT(choose_some(5, 0), IsEmpty());
}

TEST(ChooseSome, IsTheSameOnEveryMachine) {
  // mt19937_64 is fixed by the standard; with it these numbers, taken down once
  EXPECT_THAT(choose_some(1000, 4), ElementsAre(300U, 431U, 459U, 563U));
}

TEST(ChooseSome, LooksEverywhere) {
  // 1,000 of 10,000 in ten equal drawers: 100 each, with a standard deviation below √100; five of them
  std::vector<int> drawers(10, 0);
  for (const std::size_t n : choose_some(10000, 1000)) ++drawers[n / 1000];
  for (const int count : drawers) EXPECT_NEAR(count, 100, 50);
}

}  // namespace
}  // namespace farlod
