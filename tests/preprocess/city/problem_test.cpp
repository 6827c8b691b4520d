// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/problem.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace farlod {
namespace {

TEST(ProblemCodes, AscendAndAreUnique) {
  for (std::size_t n = 1; n < problem_descriptions.size(); ++n)
    EXPECT_LT(problem_descriptions[n - 1].code, problem_descriptions[n].code) << problem_descriptions[n].slug;
}

TEST(ProblemCodes, AreDescribedByThemselves) {
  for (const ProblemDescription& d : problem_descriptions) EXPECT_EQ(describe(d.code).slug, d.slug);
}

TEST(ProblemCodes, BelongToAStage) {
  for (const ProblemDescription& d : problem_descriptions) {
    const int stage = static_cast<int>(d.code) / 100;
    EXPECT_TRUE(1 <= stage && stage <= 4) << d.slug;
  }
}

TEST(ProblemCodes, HaveNamesForFilesAndSentencesForPeople) {
  std::set<std::string_view> slugs;
  for (const ProblemDescription& d : problem_descriptions) {
    EXPECT_TRUE(std::regex_match(std::string(d.slug), std::regex("[a-z]+(_[a-z]+)*"))) << d.slug;
    EXPECT_TRUE(slugs.insert(d.slug).second) << d.slug << " names two problems";
    EXPECT_FALSE(d.summary.empty());
  }
}

TEST(ProblemCodes, ANumberThatIsNoCodeIsRefused) { EXPECT_THROW((void)describe(static_cast<ProblemCode>(999)), InvalidArgument); }

TEST(Report, KeepsProblemsInTheOrderInWhichTheyWereMet) {
  Report report;
  report.add({ProblemCode::zero_area, "town.gml", "house 1", ""});
  report.add({ProblemCode::repeated_id, "town.gml", "house 1", ""});
  report.add({ProblemCode::zero_area, "town.gml", "house 2", ""});
  EXPECT_EQ(report.count(ProblemCode::zero_area), 2U);
  EXPECT_EQ(report.count(ProblemCode::not_planar), 0U);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::repeated_id);
  EXPECT_EQ(report.problems()[2].place, "house 2");
}

}  // namespace
}  // namespace farlod
