// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "farlod/error.hpp"
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

/// What a run has in memory beside what it holds: the program and its libraries (memory_mib_of_program of PackEstimate).
constexpr double program_mib = 50.0;

double mib_of_package(const nlohmann::json& summary) { return summary.at("package_bytes").get<double>() / 1048576.0; }

TEST_P(PackEstimate, KeepsItsPromise) {
  const std::optional<double> held =
      folder.held_mib(std::string("farlod-pack city.gml -o a.farlod --threads 2 --summary s.json ") + GetParam());
  const nlohmann::json summary = folder.json_of("s.json"), estimate = summary.at("estimate");
  EXPECT_GT(estimate.at("package_mib"), mib_of_package(summary) / promised_factor);
  EXPECT_LT(estimate.at("package_mib"), mib_of_package(summary) * promised_factor);
  // The estimate counts pages of files, too, of which a machine keeps as many as it likes
  EXPECT_GT(estimate.at("memory_mib"), (held.value_or(0.0) + program_mib) / promised_factor);
}
INSTANTIATE_TEST_SUITE_P(Settings, PackEstimate,
                         testing::Values("--cell 50", "--cell 25", "--cell 100", "--far-map box", "--neighborhood 7"));

/// What packing a city holds, in bytes, and its polygons.
std::pair<double, double> bytes_and_polygons(const WorkFolder& folder, const std::string& size_m) {
  folder.must("farlod-city -o c.obj --size " + size_m + " --seed 1 --towers 0.3 --rotation 20 --quiet");
  const std::optional<double> held =
      folder.held_mib("farlod-pack c.obj --crs EPSG:32632 -o c.farlod --force --cell 200 --threads 1 --summary c.json");
  return {1048576.0 * held.value_or(0.0), folder.json_of("c.json").at("polygons").get<double>()};
}

TEST(PackMemory, GrowsByLessThanTheCityAndItsTiles) {
  // Some 90, of what is at work in a block. With the city and its tiles in memory it would be some 280 more: from this size on,
  // they lie on disk
  constexpr double most_bytes = 200.0;
  const WorkFolder folder;
  const auto [bytes_of_town, polygons_of_town] = bytes_and_polygons(folder, "3000");
  const auto [bytes_of_city, polygons_of_city] = bytes_and_polygons(folder, "5000");
  EXPECT_LT((bytes_of_city - bytes_of_town) / (polygons_of_city - polygons_of_town), most_bytes);
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
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps memory of its own";
#endif
  expect_refusal(folder.run("farlod-pack city.gml -o a.farlod --memory-limit 100"), exit_limit_reached,
                 {"cells needs at least", "MiB, more than --memory-limit 100", "raise the limit to that", "fewer inputs"});
  EXPECT_FALSE(folder.has("a.farlod"));
}

TEST_F(PackLimit, EndsTheRunWhereverItsMemoryExceedsIt) {
  expect_refusal(folder.run("farlod-pack city.gml -o a.farlod --memory-limit 1"), exit_limit_reached,
                 {"needs more than", "1 MiB are allowed", "raise the memory limit"});
  EXPECT_FALSE(folder.has("a.farlod"));
}

/// The files of a package and what they hold.
std::map<std::string, std::string> contents(const WorkFolder& folder, const std::string& package) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path(package)))
    if (entry.is_regular_file()) {
      const std::string name = entry.path().lexically_relative(folder.path(package)).string();
      files[name] = folder.text_of(package + "/" + name);
    }
  return files;
}

/// What the least limit leaves to pages of files (MemoryBound::least_of_files).
constexpr double files_mib = 48.0;

int least_limit_of(const WorkFolder& folder, const std::string& summary) {
  return static_cast<int>(std::ceil(folder.json_of(summary).at("estimate").at("least_memory_mib").get<double>()));
}

TEST(PackWithinALimit, TheLeastThatIsToldIsKeptAndChangesNoByte) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps memory of its own";
#endif
  const WorkFolder folder;
  const std::string pack = "farlod-pack city.obj --crs EPSG:32632 --threads 2 -o ";
  // Half a million polygons: without a limit, two blocks are in work, and more of what lies on disk is in use
  folder.must("farlod-city -o city.obj --size 7000 --seed 1 --towers 0.3 --rotation 20 --quiet");
  folder.must(pack + "free.farlod --summary free.json");
  const int least = least_limit_of(folder, "free.json");
  const std::string below = std::to_string(least - 1), tight = std::to_string(least);
  expect_refusal(folder.run(pack + "a.farlod --memory-limit " + below), exit_limit_reached,
                 {"needs at least " + tight + " MiB", "--memory-limit " + below});
  const std::optional<double> held = folder.held_mib(pack + "tight.farlod --memory-limit " + tight);
  if (held) {
    EXPECT_LE(*held, least - files_mib - program_mib);
  }
  EXPECT_GT(folder.json_of("free.json").at("estimate").at("memory_mib"), least) << "or the limit is nothing to it";
  EXPECT_EQ(contents(folder, "tight.farlod"), contents(folder, "free.farlod"));
}

TEST_F(PackLimit, HoldsForAnArea) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps memory of its own";
#endif
  const std::string area = " --cell 25 --area 549500,5499500,550500,5500500";  // some blocks of 800 m
  folder.must("farlod-pack city.gml --threads 4 -o free.farlod --summary free.json" + area);
  const int least = least_limit_of(folder, "free.json");
  const std::optional<double> held =
      folder.held_mib("farlod-pack city.gml --threads 4 -o tight.farlod --memory-limit " + std::to_string(least) + area);
  if (held) {
    EXPECT_LE(*held, least - files_mib - program_mib);
  }
  EXPECT_EQ(contents(folder, "tight.farlod"), contents(folder, "free.farlod"));
}

TEST_F(PackLimit, ACityMayComeThroughAPipe) {
  folder.must("farlod-pack city.gml -o read.farlod");
  folder.must("cat city.gml | farlod-pack - -o piped.farlod");
  std::map<std::string, std::string> piped = contents(folder, "piped.farlod"), read = contents(folder, "read.farlod");
  // The manifest names the inputs, and nothing can be inserted into a pipe
  EXPECT_EQ(piped.erase("manifest.json") + read.erase("manifest.json") + read.erase("sources.bin"), 3U);
  EXPECT_EQ(piped, read);
}

TEST_F(PackLimit, ACityMayGoThroughAPipe) {
  folder.must("farlod-city -o city.obj --size 500 --seed 1 --quiet && mkdir piped && mkfifo piped/city.obj");
  folder.must("{ farlod-city -o piped/city.obj --size 500 --seed 1 --quiet & cat piped/city.obj > through.obj && wait $!; }");
  EXPECT_TRUE(folder.text_of("through.obj") == folder.text_of("city.obj"));
  EXPECT_FALSE(std::filesystem::is_regular_file(folder.path("piped/city.obj")));
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
