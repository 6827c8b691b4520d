// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "farlod/error.hpp"
#include "tests/acceptance/csv_table.hpp"
#include "tests/acceptance/random_towns.hpp"
#include "tests/acceptance/work_folder.hpp"

// Values that come back into all files of a folder.

namespace farlod::acceptance {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A CityJSON file with one house of 10 m.
std::string house(const std::string& id, int east_m) {
  return R"({"type":"CityJSON","version":"2.0","CityObjects":{")" + id +
         R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[4,5,6,7]],[[0,3,2,1]],[[0,1,5,4]],)"
         R"([[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]],"semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"GroundSurface"},)"
         R"({"type":"WallSurface"}],"values":[0,1,2,2,2,2]}}]}},"vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],)"
         R"([10,0,10],[10,10,10],[0,10,10]],"transform":{"scale":[1,1,1],"translate":[)" +
         std::to_string(500000 + east_m) + ",5500000,100]}}";
}

class EnrichedFolder : public testing::Test {
 protected:
  EnrichedFolder() {
    folder.must("mkdir -p in/east");
    folder.write("in/west.city.json", house("w", 0));
    folder.write("in/east/east.city.json", house("e", 100));
    folder.must("farlod-pack in -o a.farlod --quiet --crs EPSG:32632");
  }
  [[nodiscard]] Outcome enriched(const std::string& arguments) const {
    return folder.run("farlod-svf a.farlod --surfaces all --spacing 5 " + arguments);
  }
  void expect_refused(const std::string& arguments, int exit_code, const testing::Matcher<std::string>& said) const {
    const Outcome outcome = enriched(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    EXPECT_THAT(outcome.err, said) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }

  WorkFolder folder;
};

TEST_F(EnrichedFolder, EachFileIsAsOfARunOfItsOwn) {
  const Outcome outcome = enriched("--city in -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const std::string name : {"west.city.json", "east/east.city.json"}) {
    folder.must("farlod-svf a.farlod --quiet --surfaces all --spacing 5 --city in/" + name + " -o one.city.json");
    EXPECT_THAT(folder.text_of("out/" + name), HasSubstr("\"svf_walls\":"));
    EXPECT_EQ(folder.text_of("out/" + name), folder.text_of("one.city.json")) << name;
    EXPECT_EQ(without_values(folder.text_of("out/" + name)), folder.text_of("in/" + name)) << name;
  }
}

TEST_F(EnrichedFolder, OtherFilesStayOutAndAreTold) {
  folder.write("in/far.city.json", house("f", 900));
  folder.write("in/notes.txt", "of no format");
  folder.must("mv in/east/east.city.json .");
  const Outcome outcome = enriched("--city in -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, AllOf(HasSubstr("far.city.json is no file of the package"),
                                               HasSubstr("east.city.json is not in in"), testing::Not(HasSubstr("notes.txt"))));
  EXPECT_EQ(folder.run("ls out").out, "west.city.json\n");
}

TEST_F(EnrichedFolder, WrongUsesAreOneLine) {
  expect_refused("--city in -o in", exit_unusable_input, HasSubstr("it is the file of --city; choose another name for -o"));
  expect_refused("--city in -o out.city.json", exit_usage, HasSubstr("--city is a folder, and so is the output"));
  folder.must("mkdir empty");
  expect_refused("--city empty -o out", exit_unusable_input,
                 HasSubstr("empty holds no CityGML or CityJSON file that a.farlod was made of"));
  folder.write("word", "");
  expect_refused("--city in -o word", exit_unusable_input, HasSubstr("choose a folder for -o, too"));
  folder.must("mkdir -p out/east && cp in/east/east.city.json out/east");
  expect_refused("--city in -o out", exit_unusable_input, HasSubstr("out/east/east.city.json: it is there already"));
  EXPECT_EQ(folder.run("ls out").out, "east\n");
}

TEST_F(EnrichedFolder, AnEstimateWritesNothing) {
  EXPECT_EQ(enriched("--city in -o out --dry-run").exit_code, 0);
  EXPECT_NE(folder.run("ls out").exit_code, 0);
}

/// A column by which tables are joined with the file.
TEST_F(EnrichedFolder, TablesHaveTheIdsOfTheFiles) {
  ASSERT_EQ(enriched("-o o.csv").exit_code, 0);
  const CsvTable table(folder.text_of("o.surfaces.csv"));
  ASSERT_EQ(table.size(), 10U);
  for (std::size_t n = 0; n < table.size(); ++n)
    EXPECT_EQ(table.text(n, "surface_id"), table.text(n, "building") + (table.text(n, "kind") == "roof" ? "#0" : "#2"));
  EXPECT_EQ(table.header().back(), "surface_id");
  ASSERT_EQ(enriched("-o o.geojson").exit_code, 0);
  for (const nlohmann::json& feature : folder.json_of("o.surfaces.geojson").at("features")) {
    const nlohmann::json& properties = feature.at("properties");
    EXPECT_THAT(properties.at("surface_id").get<std::string>(),
                testing::StartsWith(properties.at("building").get<std::string>()));
  }
  ASSERT_EQ(enriched("-o p.csv --threads 1").exit_code, 0);
  EXPECT_EQ(folder.text_of("o.surfaces.csv"), folder.text_of("p.surfaces.csv"));
}

/// Files that have no places for attributes have ids as well.
TEST_F(EnrichedFolder, TablesOfPackedFilesHaveIds) {
  folder.must("gzip in/west.city.json && farlod-pack in/west.city.json.gz -o b.farlod --quiet --crs EPSG:32632");
  folder.must("farlod-svf b.farlod -o o.csv --surfaces roofs --quiet && farlod-info b.farlod --check");
  EXPECT_EQ(CsvTable(folder.text_of("o.surfaces.csv")).text(0, "surface_id"), "w#0");
}

}  // namespace
}  // namespace farlod::acceptance
