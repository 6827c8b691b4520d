// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verification.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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
