// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/problems/problem_lists.hpp"

#include <gtest/gtest.h>

// One problem = one code = one file = one paragraph. What each file yields is tested with the stage that reports it.

namespace farlod::test {
namespace {

TEST(ProblemLists, EachProblemHasOneFixtureAndEachFixtureItsProblem) {
  std::vector<ProblemName> names;
  for (const Fixture& f : fixtures()) names.push_back(f.name);
  EXPECT_EQ(names, described_problems());
}

TEST(ProblemLists, EachProblemHasOneParagraphAndEachParagraphItsProblem) {
  EXPECT_EQ(documented_problems(), described_problems());
}

TEST(ProblemLists, EachProblemBelongsToAStageThatTestsItsFixture) {
  // Ingest tests its own files, the pipeline those of all later stages
  EXPECT_EQ(fixtures_of_stages(1, 1).size() + fixtures_of_stages(2, 4).size(), described_problems().size());
}

TEST(ProblemLists, NamesWithoutACodeAreToldApart) {
  EXPECT_EQ(problem_name("104 ring_not_closed"), ProblemName(104, "ring_not_closed"));
  EXPECT_EQ(problem_name("104_ring_not_closed"), ProblemName(104, "ring_not_closed"));
  EXPECT_EQ(problem_name("ring_not_closed").first, 0);
}

}  // namespace
}  // namespace farlod::test
