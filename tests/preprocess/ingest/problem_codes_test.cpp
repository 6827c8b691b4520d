// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"
#include "tests/problems/problem_lists.hpp"

namespace farlod::test {
namespace {

class BrokenFile : public testing::TestWithParam<Fixture> {};

TEST_P(BrokenFile, HasExactlyItsProblem) {
  const Reading r = read_file(GetParam().path);
  EXPECT_EQ(r.codes(), std::set<int>{GetParam().name.first});
  EXPECT_EQ(r.report.problems().size(), 1U);
  EXPECT_EQ(r.city().buildings()[0].facet_count, 6U) << "the good house must survive";
}

INSTANTIATE_TEST_SUITE_P(Ingest, BrokenFile, testing::ValuesIn(fixtures_of_stages(1, 1)),
                         [](const auto& test) { return test.param.name.second; });

}  // namespace
}  // namespace farlod::test
