// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// farlod-info, as users type it
#include <gmock/gmock.h>

#include <regex>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

class Info : public PackedTown {
 protected:
  [[nodiscard]] json facts(const std::string& arguments = "") const {
    const Outcome outcome = folder.run("farlod-info a.farlod --json " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
    return json::parse(outcome.out);
  }
  /// Of all files of that name.
  [[nodiscard]] std::uintmax_t bytes_of(const std::string& name) const {
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("a.farlod")))
      if (entry.path().filename() == name) bytes += entry.file_size();
    return bytes;
  }
  /// A file of that name.
  [[nodiscard]] std::string file(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("a.farlod")))
      if (entry.path().filename() == name) return fs::relative(entry.path(), folder.path("")).string();
    ADD_FAILURE() << name;
    return "";
  }
  void turn_a_bit(const std::string& name, double share) const {
    std::string bytes = folder.text_of(file(name));
    char& byte = bytes[static_cast<std::size_t>(share * static_cast<double>(bytes.size()))];
    byte = static_cast<char>(byte ^ 1);
    folder.write(file(name), bytes);
  }
};

TEST_F(Info, TellsWhatAPackageHolds) {
  const Outcome outcome = folder.run("farlod-info a.farlod/");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_EQ(outcome.err, "");
  for (const char* said :
       {"a.farlod, format version 10, written by farlod-pack", "(EPSG:32632)", "bearing 20.00° from true north",
        "36 buildings, 216 polygons", "cells of 150 m", "kind horizon, in all", "town.geojson, ", "XXH3 ", "Problems      none"})
    EXPECT_THAT(outcome.out, HasSubstr(said));
}

TEST_F(Info, JsonAgreesWithTheManifest) {
  const json said = facts(), manifest = folder.json_of("a.farlod/manifest.json");
  EXPECT_EQ(said.at("format_version"), manifest.at("version"));
  EXPECT_EQ(said.at("crs"), manifest.at("crs"));
  EXPECT_EQ(said.at("grid").at("cells"), manifest.at("grid").at("cells"));
  EXPECT_EQ(said.at("inputs").at(0).at("name"), manifest.at("inputs").at(0).at("name"));
  EXPECT_EQ(std::stoull(said.at("inputs").at(0).at("xxh3").get<std::string>(), nullptr, 16),
            std::stoull(manifest.at("inputs").at(0).at("xxh3").get<std::string>(), nullptr, 16));
  for (const char* count : {"buildings", "polygons", "triangles"}) EXPECT_EQ(said.at(count), manifest.at("counts").at(count));
  EXPECT_EQ(said.at("tile_bytes"), bytes_of("tiles.bin"));
  EXPECT_EQ(said.at("far_map_bytes"), bytes_of("far.exr"));
  EXPECT_NEAR(said.at("grid").at("true_bearing_deg"), town_bearing.degrees(), 0.01);
}

TEST_F(Info, ProblemsHaveTheirNames) {
  folder.write("more.geojson", R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}},
    "features": [{"type": "Feature", "properties": {"height": 9}, "geometry": {"type": "Point", "coordinates": [500000, 5500000]}}]})");
  folder.must("farlod-pack town.geojson more.geojson -o b.farlod --quiet");
  EXPECT_THAT(folder.run("farlod-info b.farlod").out, HasSubstr("1 × 119 unusable_file: "));
  EXPECT_EQ(json::parse(folder.run("farlod-info b.farlod --json").out).at("problems"), json({{"119", 1}}));
}

TEST_F(Info, TellsHowManyCellsHaveAFarMap) {
  folder.must("farlod-pack town.geojson -o b.farlod --quiet --area 499999,5499999,500001,5500001");
  const json said = json::parse(folder.run("farlod-info b.farlod --json --check").out);
  EXPECT_EQ(said.at("format_version"), 10);
  EXPECT_LT(said.at("far_map").at("cells"), said.at("grid").at("cell_count"));
  EXPECT_EQ(said.at("check").at("far_maps"), said.at("far_map").at("cells"));
  EXPECT_EQ(said.at("check").at("damage"), json::array());
}

TEST_F(Info, AWholePackagePassesTheCheck) {
  const Outcome outcome = folder.run("farlod-info a.farlod --check --threads 2");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, HasSubstr("the package is whole"));
  EXPECT_EQ(facts("--check").at("check").at("far_maps"), facts().at("grid").at("cell_count"));
}

TEST_F(Info, TheCheckTellsEachDamage) {
  turn_a_bit("tiles.bin", 0.5);
  turn_a_bit("far.exr", 0.6);
  EXPECT_EQ(folder.run("farlod-info a.farlod").exit_code, exit_done) << "the manifest is whole";
  const Outcome outcome = folder.run("farlod-info a.farlod --check");
  EXPECT_EQ(outcome.exit_code, exit_damaged_package);
  EXPECT_THAT(outcome.err, HasSubstr("tiles.bin is damaged: its checksum"));
  EXPECT_THAT(outcome.err, HasSubstr("far.exr is damaged: its checksum"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("is whole")));
  const Outcome quiet = folder.run("farlod-info a.farlod --check --quiet");
  EXPECT_EQ(quiet.exit_code, exit_damaged_package);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.err, outcome.err);
  const Outcome as_json = folder.run("farlod-info a.farlod --check --json");
  EXPECT_EQ(as_json.exit_code, exit_damaged_package);
  const json damage = json::parse(as_json.out).at("check").at("damage");
  ASSERT_GE(damage.size(), 2U);
  EXPECT_EQ("a.farlod/" + damage[0].at("file").get<std::string>(), file("tiles.bin"));
  EXPECT_TRUE(damage[0].at("cell").is_null());
}

TEST_F(Info, ThreadsChangeNothing) {
  turn_a_bit("far.exr", 0.6);
  const Outcome one = folder.run("farlod-info a.farlod --check --threads 1");
  const Outcome four = folder.run("farlod-info a.farlod --check --threads 4");
  EXPECT_EQ(one.out, four.out);
  EXPECT_EQ(one.err, four.err);
}

TEST_F(Info, ADamagedManifestIsTold) {
  folder.write("a.farlod/manifest.json", "{\"name\": \"a web application\"}");
  expect_refusal(folder.run("farlod-info a.farlod --check"), exit_damaged_package, {"manifest.json is damaged"});
}

TEST_F(Info, ACellTellsWhatItHolds) {
  const json cells = facts().at("grid").at("cells");
  const std::string place = std::to_string(cells[0].get<int>()) + "," + std::to_string(cells[1].get<int>());
  const json cell = facts("--cell " + place).at("cell");
  EXPECT_EQ(cell.at("cell"), json({cells[0], cells[1]}));
  EXPECT_GT(cell.at("far_map_bytes"), 0);
  EXPECT_THAT(folder.run("farlod-info a.farlod --cell " + place).out,
              HasSubstr(std::to_string(cell.at("triangles").get<int>()) + " triangles, "));
}

/// What is written is a city file: packed again, it has the buildings of the neighborhood.
TEST_F(Info, TheObjFileCanBePacked) {
  const json cells = facts().at("grid").at("cells");
  const std::string place = std::to_string(cells[0].get<int>() + 1) + "," + std::to_string(cells[1].get<int>() + 1);
  folder.must("farlod-info a.farlod --quiet --cell " + place + " --obj near.obj");
  const std::string text = folder.text_of("near.obj");
  static const std::regex offset("# Offset: add ([0-9]+) to x and ([0-9]+) to y");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(text, found, offset));
  folder.must("farlod-pack near.obj -o b.farlod --crs EPSG:32632 --origin " + found[1].str() + "," + found[2].str() + " --quiet");
  const json again = json::parse(folder.run("farlod-info b.farlod --json").out);
  std::size_t groups = 0;
  for (const std::string& line : lines_of(text)) groups += line.starts_with("g block") ? 1 : 0;
  EXPECT_GT(groups, 3U);
  EXPECT_THAT(text, HasSubstr("\ng ground\n"));
  // The grid has three cells a side or a little more: the town fits into the neighborhood of its middle, or nearly
  EXPECT_LE(groups, 36U);
  EXPECT_NEAR(again.at("grid").at("true_bearing_deg"), town_bearing.degrees(), 0.1);
}

TEST_F(Info, PicturesOfACell) {
  const json cells = facts().at("grid").at("cells");
  const std::string place = std::to_string(cells[0].get<int>()) + "," + std::to_string(cells[1].get<int>());
  for (const std::string kind : {"horizon", "box"}) {
    folder.must("farlod-pack town.geojson -o " + kind + ".farlod --cell 40 --far-map " + kind + " --quiet");
    for (const std::string ending : {".png", ".svg", ".pdf"}) {
      const std::string draw = "farlod-info " + kind + ".farlod --quiet --cell 0,0 --png ";
      folder.must(draw + "one" + ending + " --threads 1");
      folder.must(draw + "two" + ending + " --threads 3");
      EXPECT_GT(folder.text_of("one" + ending).size(), 10'000U);
      EXPECT_TRUE(folder.text_of("one" + ending) == folder.text_of("two" + ending)) << ending;
    }
    EXPECT_THAT(folder.text_of("one.svg"), HasSubstr("<title>Cell 0,0 of " + kind + ".farlod</title>"));
  }
}

TEST_F(Info, RefusesInOneLine) {
  struct Refused {
    std::string arguments;
    int exit_code;
    std::vector<std::string> said;
  };
  for (const Refused& r : {Refused{"lost.farlod", exit_unusable_input, {"lost.farlod is not a package"}},
                           Refused{"", exit_usage, {"PACKAGE is required"}},
                           Refused{"a.farlod --cell 3", exit_usage, {"--cell", "\"3\" is not of the form I,J"}},
                           Refused{"a.farlod --cell 1,2,3", exit_usage, {"--cell", "I,J"}},
                           Refused{"a.farlod --cell 1,x", exit_usage, {"--cell", "I,J"}},
                           Refused{"a.farlod --cell 99,0", exit_unusable_input, {"a.farlod has no cell 99,0: i goes from"}},
                           Refused{"a.farlod --obj o.obj", exit_usage, {"--obj", "it goes with --cell"}},
                           Refused{"a.farlod --png o.png", exit_usage, {"--png", "it goes with --cell"}},
                           Refused{"a.farlod --cell 0,0 --png o.jpg", exit_usage, {"--png", "o.jpg", ".png, .svg, .pdf"}},
                           Refused{"a.farlod --cell 0,0 --obj lost/o.obj", exit_unusable_input, {"lost/o.obj", "no folder lost"}},
                           Refused{"a.farlod --summary lost/s.json", exit_unusable_input, {"no folder lost"}},
                           Refused{"a.farlod --threads 0", exit_usage, {"--threads", "1 to 4096"}}}) {
    const std::vector<std::string> before = folder.names();
    SCOPED_TRACE(r.arguments);
    expect_refusal(folder.run("farlod-info " + r.arguments), r.exit_code, r.said);
    EXPECT_EQ(folder.names(), before);
  }
}

}  // namespace
}  // namespace farlod::acceptance
