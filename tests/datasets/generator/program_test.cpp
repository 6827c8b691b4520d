// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "generator/city_layout.hpp"
#include "tests/console/help_options.hpp"
#include "tests/counted/held_memory.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

struct Outcome {
  int exit_code;
  std::string text;  ///< both streams
};

class FarlodCity : public ::testing::Test {
 protected:
  [[nodiscard]] std::string text_of(const std::string& name) const { return scenes::text_of(folder_.file(name)); }
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() + "' && '" + std::string(FARLOD_BIN_DIR) + "/farlod-city' " +
                                arguments + " > said.txt 2>&1";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), text_of("said.txt")};
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(FarlodCity, HelpStartsWithOneLineAndAnExample) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.text, StartsWith("farlod-city — "));
  EXPECT_THAT(help.text.substr(help.text.find('\n')), StartsWith("\n\nTry this first:\n  farlod-city -o "));
}

/// An option that is added, renamed or removed changes this list.
TEST_F(FarlodCity, ListsTheseOptionsAndNoOthers) {
  std::istringstream words(
      "--help --version --size --rotation --seed --buildings --avenue-spacing "
      "--street-spacing --avenue-width --street-width --towers --max-height --height-scale --terrain-relief "
      "--lod --eaves --wrong-bases --overhangs --open-shells --balconies --projecting-floors "
      "--hillside --overlapping-parts --facade-details --centre-easting --centre-northing --crs --output "
      "--obj-from-centre --trees --summary --quiet --threads --config ");
  const std::set<std::string> options{std::istream_iterator<std::string>(words), {}};
  EXPECT_THAT(test::options_in(run("--help").text), ::testing::ContainerEq(options));
}

TEST_F(FarlodCity, TellsItsVersion) { EXPECT_THAT(run("--version").text, StartsWith("farlod-city ")); }

TEST_F(FarlodCity, WritesACityAndASummary) {
  const Outcome outcome = run("-o town.obj --size 600 --overhangs --summary town.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto summary = nlohmann::json::parse(text_of("town.json"));
  EXPECT_GT(summary.at("buildings"), 0);
  EXPECT_GT(summary.at("polygons"), summary.at("buildings"));
  EXPECT_GT(summary.at("tallest_m"), 0.0);
  EXPECT_GE(summary.at("seconds").at("total"), 0.0);
  EXPECT_EQ(summary.at("output_bytes"), fs::file_size(folder_.file("town.obj")));
  EXPECT_THAT(outcome.text, HasSubstr(std::to_string(summary.at("buildings").get<int>()) + " buildings"));
}

TEST_F(FarlodCity, WritesTreesBesideACity) {
  const Outcome outcome = run("-o town.geojson --size 400 --trees trees.geojson --summary town.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto trees = nlohmann::json::parse(text_of("trees.geojson"));
  const std::size_t count = trees.at("features").size();
  EXPECT_EQ(nlohmann::json::parse(text_of("town.json")).at("trees"), count);
  EXPECT_THAT(outcome.text, HasSubstr("trees.geojson: " + std::to_string(count) + " trees"));
  EXPECT_GT(count, 200U);
  std::size_t evergreen = 0;
  for (const auto& tree : trees.at("features")) {
    const auto& p = tree.at("properties");
    EXPECT_GE(p.at("height"), 5.0);
    EXPECT_LE(p.at("height"), 18.0);
    EXPECT_LT(p.at("trunk_height"), p.at("height"));
    EXPECT_GT(p.at("crown_diameter"), 1.5);
    evergreen += p.at("leaf_cycle") == "evergreen" ? 1 : 0;
    // The city is 400 m wide, around its centre
    EXPECT_LT(std::abs(tree.at("geometry").at("coordinates").at(0).get<double>() - 550000.0), 200.0);
    EXPECT_LT(std::abs(tree.at("geometry").at("coordinates").at(1).get<double>() - 5500000.0), 200.0);
  }
  EXPECT_GT(evergreen, count / 20);
  EXPECT_LT(evergreen, count / 4);
  // Trees change no building, and are the same each time
  EXPECT_EQ(run("-o town.geojson --size 400 --quiet --trees other.geojson").exit_code, 0);
  EXPECT_EQ(text_of("other.geojson"), text_of("trees.geojson"));
  const std::string with_trees = text_of("town.geojson");
  EXPECT_EQ(run("-o town.geojson --size 400 --quiet").exit_code, 0);
  EXPECT_EQ(text_of("town.geojson"), with_trees);
}

TEST_F(FarlodCity, QuietSaysNothing) {
  const Outcome outcome = run("-o town.geojson --size 200 --quiet");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.text, "");
}

TEST_F(FarlodCity, TakesOptionsFromAFile) {
  std::ofstream(folder_.file("town.toml")) << "size = 300\nseed = 9\n";
  EXPECT_EQ(run("-o a.obj --config town.toml --quiet").exit_code, 0);
  EXPECT_EQ(run("-o b.obj --size 300 --seed 9 --quiet").exit_code, 0);
  // The first line holds the file's name
  EXPECT_EQ(text_of("a.obj").substr(text_of("a.obj").find('\n')), text_of("b.obj").substr(text_of("b.obj").find('\n')));
}

TEST_F(FarlodCity, WrongUsageIsTwoAndSaysWhat) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "--output"},
      {"-o town.tif", ".city.json"},
      {"-o town.obj --size 3", "--size is 3; it must be between 100 and 200000"},
      {"-o town.obj --size abc", "--size"},
      {"-o town.obj --towers 2", "--towers"},
      {"-o town.obj --lod 3", "--lod"},
      {"-o town.obj --crs 32632", "EPSG:32632"},
      {"-o town.obj --crs EPSG:4326", "degrees"},
      {"-o town.obj --size 300 --buildings 100", "--buildings"},
      {"-o town.obj --buildings 0", "--buildings is 0"},
      {"-o town.gml --obj-from-centre", ".obj"},
      {"-o town.obj --frobnicate", "--frobnicate"},
      {"-o town.obj --eaves 0.5", "--lod 2"},
      {"-o town.obj --hillside --terrain-relief 20", "--terrain-relief"},
      {"-o town.geojson --open-shells", "--open-shells: cannot be shown by the footprints of .geojson"},
      {"-o town.geojson --lod 2 --eaves 0.5", "--eaves: cannot be shown"},
      {"-o town.geojson --lod 2 --balconies", "--balconies: cannot be shown"},
      {"-o town.geojson --projecting-floors", "--projecting-floors: cannot be shown"},
      {"-o town.geojson --lod 2 --facade-details", "--facade-details: cannot be shown"},
  };
  for (const auto& [arguments, said] : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(said)) << arguments;
    for (const char* name : {"town.obj", "town.geojson"}) EXPECT_FALSE(fs::exists(folder_.file(name))) << arguments;
  }
}

TEST_F(FarlodCity, FootprintsShowHillsidesPartsAndWrongBases) {
  const Outcome outcome = run("-o town.geojson --size 500 --hillside --overlapping-parts --wrong-bases 0.1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
}

TEST_F(FarlodCity, WhatCannotBeWrittenIsThree) {
  const Outcome outcome = run("-o nowhere/town.obj --size 200");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.text, HasSubstr("nowhere/town.obj"));
}

struct CityRun {
  double buildings, held_bytes;
};

/// Makes a city in a process of its own, which tells the most that it has held at a time.
CityRun make_city(const fs::path& folder, const std::string& file, int size_m) {
  const std::string command = "cd '" + folder.string() + "' && LD_PRELOAD='" + FARLOD_HELD_MEMORY_LIBRARY +
                              "' FARLOD_HELD_MEMORY=held '" + FARLOD_BIN_DIR + "/farlod-city' --quiet --overhangs -o " + file +
                              " --size " + std::to_string(size_m) + " --summary summary.json";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream text(folder / "summary.json"), held(folder / "held");
  CityRun run{nlohmann::json::parse(text).at("buildings"), 0.0};
  held >> run.held_bytes;
  EXPECT_TRUE(held);
  return run;
}

/// Whoever kept a city in memory would keep its corners at least, and no building has fewer than eight.
constexpr double least_bytes_of_a_kept_building = 8.0 * sizeof(PointMm);

class Memory : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, Memory, ::testing::Values("c.gml", "c.city.json", "c.obj", "c.geojson"));

TEST_P(Memory, DoesNotGrowWithTheCity) {
  if (!HeldMemory::counts_malloc) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  const scenes::TemporaryFolder folder;
  // Both cities are large enough to fill the writers' buffers, which are of fixed size
  const CityRun small = make_city(folder.path(), GetParam(), 3000), large = make_city(folder.path(), GetParam(), 5000);
  ASSERT_GT(large.buildings, 2.0 * small.buildings);
  EXPECT_LT(large.held_bytes - small.held_bytes, least_bytes_of_a_kept_building * (large.buildings - small.buildings));
  RecordProperty("growth_bytes", std::to_string(large.held_bytes - small.held_bytes));
}

const fs::path datasets = fs::path(FARLOD_SOURCE_DIR) / "datasets";

/// The commands of the README's table, by the name of the sample that they make.
std::map<std::string, std::string> commands() {
  const std::string readme = scenes::text_of(datasets / "README.md");
  const std::regex command("`farlod-city (-o samples/([^ `]+)[^`]*)`");
  std::map<std::string, std::string> result;
  for (std::sregex_iterator m(readme.begin(), readme.end(), command), end; m != end; ++m) result[(*m)[2]] = (*m)[1];
  return result;
}

TEST(Samples, EachFileHasItsCommandAndEachCommandItsFile) {
  std::map<std::string, std::string> rows = commands();
  for (const auto& entry : fs::directory_iterator(datasets / "samples"))
    EXPECT_EQ(rows.erase(entry.path().filename().string()), 1U) << entry.path().filename();
  for (const auto& [name, arguments] : rows) ADD_FAILURE() << name << " is in the README and not there";
}

TEST(Samples, AreSmall) {
  for (const auto& entry : fs::directory_iterator(datasets / "samples")) EXPECT_LT(entry.file_size(), 150'000U) << entry.path();
}

TEST(Samples, EachIsMadeAgainToTheByte) {
  const scenes::TemporaryFolder folder;
  fs::create_directory(folder.file("samples"));
  ASSERT_FALSE(commands().empty());
  for (const auto& [name, arguments] : commands()) {
    const std::string line =
        "cd '" + folder.path().string() + "' && '" + std::string(FARLOD_BIN_DIR) + "/farlod-city' --quiet " + arguments;
    ASSERT_EQ(std::system(line.c_str()), 0) << line;
    EXPECT_TRUE(scenes::text_of(folder.file("samples") / name) == scenes::text_of(datasets / "samples" / name))
        << name << " differs: if the generator was meant to change, run the README's commands in datasets/";
  }
}

}  // namespace
}  // namespace farlod
