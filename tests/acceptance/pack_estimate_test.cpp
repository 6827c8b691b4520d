// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "console/exit_code.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What PackEstimate promises.
constexpr double promised_factor = 2.0;

class PackEstimate : public testing::TestWithParam<const char*> {
 protected:
  PackEstimate() { folder.must("farlod-city -o city.gml --size 1500 --seed 1 --towers 0.3 --rotation 20 --quiet"); }
  WorkFolder folder;
};

void expect_within_the_promise(double estimate, double actual) {
  EXPECT_GT(estimate, actual / promised_factor);
  EXPECT_LT(estimate, actual * promised_factor);
}

TEST_P(PackEstimate, KeepsItsPromise) {
  folder.must(std::string("farlod-pack city.gml -o a.farlod --summary s.json ") + GetParam());
  const nlohmann::json summary = folder.json_of("s.json"), estimate = summary.at("estimate");
  expect_within_the_promise(estimate.at("package_mib"), summary.at("package_bytes").get<double>() / 1048576.0);
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps memory of its own";
#endif
  expect_within_the_promise(estimate.at("memory_mib"), summary.at("peak_memory_mib"));
}
INSTANTIATE_TEST_SUITE_P(Settings, PackEstimate,
                         testing::Values("--cell 50", "--cell 25", "--cell 100", "--far-map box", "--neighborhood 7"));

using PackLimit = PackEstimate;

TEST_F(PackLimit, TheEstimateIsTheFirstLine) {
  const Outcome outcome = folder.run("farlod-pack city.gml -o a.farlod");
  ASSERT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(
      lines_of(outcome.out).front(),
      testing::MatchesRegex("[0-9,]+ cells: about [0-9]+ s from here on, [0-9]+ MiB of memory, and a package of [0-9]+ MiB"));
  EXPECT_EQ(folder.run("farlod-pack city.gml -o b.farlod --quiet").out, "");
}

TEST_F(PackLimit, EndsTheRunBeforeTheLongWork) {
  expect_refusal(folder.run("farlod-pack city.gml -o a.farlod --memory-limit 40"), exit_limit_reached,
                 {"cells needs about", "MiB, more than --memory-limit 40", "larger cells", "fewer inputs"});
  EXPECT_FALSE(folder.has("a.farlod"));
}

TEST_F(PackLimit, IsNothingToARunThatNeedsLess) {
  EXPECT_EQ(folder.run("farlod-pack city.gml -o a.farlod --memory-limit 4000").exit_code, exit_done);
  EXPECT_TRUE(folder.has("a.farlod/manifest.json"));
}

TEST_F(PackLimit, MustBeANumberOfMebibytes) {
  for (const char* limit : {"-5", "0", "much"}) {
    const Outcome outcome = folder.run(std::string("farlod-pack city.gml -o a.farlod --memory-limit ") + limit);
    EXPECT_EQ(outcome.exit_code, exit_usage) << limit;
    EXPECT_THAT(outcome.err, HasSubstr("--memory-limit"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("internal")));
  }
}

}  // namespace
}  // namespace farlod::acceptance
