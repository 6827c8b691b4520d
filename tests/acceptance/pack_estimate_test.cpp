// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <utility>

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

/// Its summary's peak of the memory, in bytes, and its polygons.
std::pair<double, double> bytes_and_polygons(const WorkFolder& folder, const std::string& size_m) {
  folder.must("farlod-city -o c.obj --size " + size_m + " --seed 1 --towers 0.3 --rotation 20 --quiet");
  folder.must("farlod-pack c.obj --crs EPSG:32632 -o c.farlod --force --cell 200 --threads 2 --summary c.json");
  const nlohmann::json summary = folder.json_of("c.json");
  return {1048576.0 * summary.at("peak_memory_mib").get<double>(), summary.at("polygons").get<double>()};
}

TEST(PackMemory, GrowsByLessThanTheCityAndItsTiles) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps memory of its own";
#endif
  const WorkFolder folder;
  const auto [bytes_of_town, polygons_of_town] = bytes_and_polygons(folder, "1000");
  const auto [bytes_of_city, polygons_of_city] = bytes_and_polygons(folder, "5000");
  // With the city and its tiles in memory it was 690 bytes; where they lie on disk, 410
  EXPECT_LT((bytes_of_city - bytes_of_town) / (polygons_of_city - polygons_of_town), 550.0);
}

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
