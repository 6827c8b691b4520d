// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"
#include "tests/problems/problem_lists.hpp"

namespace farlod::ingest::test {
namespace {

using farlod::test::Fixture;
using farlod::test::fixtures_of_stages;
using farlod::test::good_city;
using farlod::test::is_of_trees;

std::vector<Fixture> fixtures_of_ingest(bool in_company) {
  std::vector<Fixture> files = fixtures_of_stages(1, 1);
  std::erase_if(files, [=](const Fixture& fixture) { return is_of_trees(fixture) || needs_company(fixture) != in_company; });
  return files;
}

class BrokenFile : public testing::TestWithParam<Fixture> {};

TEST_P(BrokenFile, HasExactlyItsProblem) {
  const Reading r = read_file(GetParam().path);
  EXPECT_EQ(r.codes(), std::set<int>{GetParam().name.first});
  EXPECT_EQ(r.report.problems().size(), 1U);
  EXPECT_EQ(r.city().buildings()[0].facet_count, 6U) << "the good house must survive";
}

INSTANTIATE_TEST_SUITE_P(Ingest, BrokenFile, testing::ValuesIn(fixtures_of_ingest(false)),
                         [](const auto& test) { return test.param.name.second; });

class BrokenAmongOthers : public testing::TestWithParam<Fixture> {};

TEST_P(BrokenAmongOthers, HasExactlyItsProblemAndCostsItselfOnly) {
  const std::vector<std::filesystem::path> paths = inputs_with(GetParam());
  const std::vector<InputFile> files(paths.begin(), paths.end());
  Report report;
  const std::vector<SourceCity> cities = ingest_all(files, {}, report);
  ASSERT_EQ(report.problems().size(), 1U);
  EXPECT_EQ(static_cast<int>(report.problems()[0].code), GetParam().name.first);
  EXPECT_EQ(report.problems()[0].source, GetParam().path.string());
  ASSERT_EQ(cities.size(), 1U);
  EXPECT_EQ(cities[0].source, good_city().string());
  EXPECT_EQ(cities[0].city.buildings().size(), read_file(good_city()).city().buildings().size());
}

INSTANTIATE_TEST_SUITE_P(Ingest, BrokenAmongOthers, testing::ValuesIn(fixtures_of_ingest(true)),
                         [](const auto& test) { return test.param.name.second; });

}  // namespace
}  // namespace farlod::ingest::test
