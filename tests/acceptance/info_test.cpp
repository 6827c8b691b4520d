// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/refused_command.hpp"

// farlod-info, as users type it

namespace farlod::acceptance {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
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

/// The largest picture of all: its places are those of the report, whatever CRS it is in.
TEST_F(Info, PictureOfTheCity) {
  for (const std::string ending : {".png", ".svg", ".pdf"}) {
    const std::string draw = "farlod-info a.farlod --quiet --png ";
    folder.must(draw + "one" + ending + " --threads 1");
    folder.must(draw + "two" + ending + " --threads 3");
    EXPECT_GT(folder.text_of("one" + ending).size(), 10'000U);
    EXPECT_TRUE(folder.text_of("one" + ending) == folder.text_of("two" + ending)) << ending;
  }
  EXPECT_THAT(folder.text_of("one.svg"), HasSubstr("<title>Plan of a.farlod</title>"));
}

/// Pixels of two pictures that differ to the eye, above what stands below the maps.
std::size_t differences(const RasterFile& a, const RasterFile& b) {
  constexpr std::size_t footer_rows = 160;
  constexpr double visible = 40.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.columns * (a.rows - footer_rows); ++n)
    count += std::abs(*a.values[n] - *b.values[n]) > visible ? 1 : 0;
  return count;
}

TEST_F(Info, MarksTheReportInThePictureOfTheCity) {
  folder.write("odd.geojson", R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}},
    "features": [{"type": "Feature", "properties": {"height": 9}, "geometry": {"type": "Polygon", "coordinates": [
    [[500000, 5500000], [500010, 5500000], [500010, 5500010], [500000, 5500010], [500000, 5500000]],
    [[500050, 5500030], [500060, 5500030], [500060, 5500040], [500050, 5500030]]]}}]})");
  folder.must("farlod-pack town.geojson odd.geojson -o b.farlod --quiet --report problems.geojson");
  folder.must("farlod-pack town.geojson odd.geojson -o c.farlod --quiet --report problems.json");
  ASSERT_THAT(folder.text_of("problems.geojson"), HasSubstr("hole_outside"));
  // The same two places, of the hole in the roof and of that in the floor, in the CRS of the package
  folder.write("place.csv", "x,y\n500050,5500030\n500060,5500040\n");
  const auto picture = [&](const std::string& name, const std::string& arguments) {
    folder.must("farlod-info b.farlod --quiet --png " + name + ".png " + arguments);
    folder.write(name + ".pgw", "1\n0\n0\n-1\n0\n0\n");
    return raster(name + ".png");
  };
  const RasterFile plain = picture("plain", ""), report = picture("report", "--report problems.geojson"),
                   list = picture("list", "--report problems.json"), place = picture("place", "--report place.csv");
  EXPECT_GT(differences(plain, place), 40U) << "a disc of four pixels";
  EXPECT_LT(differences(report, place), 10U) << "the two are less than a tenth of a pixel apart";
  EXPECT_EQ(differences(report, list), 0U) << "the same report in JSON";
}

TEST_F(Info, RefusesInOneLine) {
  folder.write("old.json", R"([{"code": 107, "position": [1, 2, 3]}])");
  for (const auto& [name, arguments, exit_code, said] :
       {unusable("", "lost.farlod", {"lost.farlod is not a package"}),
        wrong_usage("", "", {"PACKAGE is required"}),
        wrong_usage("", "a.farlod --cell 3", {"--cell", "\"3\" is not of the form I,J"}),
        wrong_usage("", "a.farlod --cell 1,2,3", {"--cell", "I,J"}),
        wrong_usage("", "a.farlod --cell 1,x", {"--cell", "I,J"}),
        unusable("", "a.farlod --cell 99,0", {"a.farlod has no cell 99,0: i goes from"}),
        wrong_usage("", "a.farlod --obj o.obj", {"--obj", "it goes with --cell"}),
        wrong_usage("", "a.farlod --cell 0,0 --png o.jpg", {"--png", "o.jpg", ".png, .svg, .pdf"}),
        wrong_usage("", "a.farlod --report r.geojson", {"--report", "it goes with --png, and without --cell"}),
        wrong_usage("", "a.farlod --cell 0,0 --png o.png --report r.geojson", {"--report", "without --cell"}),
        wrong_usage("", "a.farlod --cells cells.xyz", {"--cells", "cells.xyz", ".nc, .csv, .gpkg, .geojson, .fgb"}),
        wrong_usage("", "a.farlod --cells cells", {"--cells", "choose one of"}),
        wrong_usage("", "a.farlod --svf 2", {"--svf", "it goes with --cells"}),
        wrong_usage("", "a.farlod --cells cells.csv --svf 0", {"--svf", "0.05"}),
        wrong_usage("", "a.farlod --zones town.geojson", {"--zones", "it goes with --cells"}),
        wrong_usage("", "a.farlod --cells cells.csv --zones-layer blocks", {"--zones-layer", "it goes with --zones"}),
        unusable("", "a.farlod --cells cells.csv --zones lost.gpkg", {"lost.gpkg does not exist"}),
        unusable("", "a.farlod --cells town.geojson --zones town.geojson", {"cannot write town.geojson", "--zones"}),
        unusable("", "a.farlod --cells lost/cells.csv", {"lost/cells.csv", "no folder lost"}),
        unusable("", "lost.farlod --cells cells.csv", {"lost.farlod is not a package"}),
        unusable("", "a.farlod --png o.png --report lost.geojson", {"lost.geojson"}),
        unusable("", "a.farlod --png o.png --report old.json", {"old.json is JSON, but no report that says where problems are"}),
        unusable("", "a.farlod --cell 0,0 --obj lost/o.obj", {"lost/o.obj", "no folder lost"}),
        unusable("", "a.farlod --summary lost/s.json", {"no folder lost"}),
        wrong_usage("", "a.farlod --threads 0", {"--threads", "1 to 4096"})}) {
    const std::vector<std::string> before = folder.names();
    SCOPED_TRACE(arguments);
    expect_refusal(folder.run("farlod-info " + arguments), exit_code, said);
    EXPECT_EQ(folder.names(), before);
  }
}

// farlod-view, as users start it

/// Starts the program, asks for addresses below it one after the other, and ends it. The answers are in 0, 1, ...
std::string asking(const std::vector<std::string>& addresses, const std::string& options = "") {
  std::string text = "farlod-view a.farlod " + options +
                     " > said.txt 2> error.txt & viewer=$!\n"
                     "until grep -q http said.txt || ! kill -0 $viewer; do sleep 0.1; done\n"
                     "root=$(head -n 1 said.txt)\n";
  for (std::size_t n = 0; n < addresses.size(); ++n)
    text += "python3 -c 'import sys, urllib.request as u; sys.stdout.buffer.write(u.urlopen(sys.argv[1]).read())' \"${root}" +
            addresses[n] + "\" > " + std::to_string(n) + " || { kill $viewer; exit 1; }\n";
  return text + "kill $viewer; wait $viewer";
}

class View : public PackedTown {
 protected:
  [[nodiscard]] Outcome ask(const std::vector<std::string>& addresses, const std::string& options = "") const {
    return folder.run(asking(addresses, options));
  }
};

TEST_F(View, ServesThePageAndTheCity) {
  const Outcome outcome = ask({"", "viewer.js", "view.json", "tiles/0/0/0.glb"}, "--summary s.json");
  EXPECT_EQ(outcome.exit_code, exit_interrupted + 15) << outcome.err;
  EXPECT_THAT(folder.text_of("said.txt"), StartsWith("http://127.0.0.1:"));
  EXPECT_EQ(folder.text_of("error.txt"), "");
  EXPECT_THAT(folder.text_of("0"), HasSubstr("viewer.js"));
  EXPECT_EQ(folder.text_of("1"), folder.text_of(std::string(FARLOD_SOURCE_DIR) + "/viewer/bundle/viewer.js"));
  EXPECT_EQ(folder.json_of("2").at("counts").at("buildings"), 36);
  EXPECT_THAT(folder.text_of("3"), StartsWith("glTF"));
  EXPECT_EQ(folder.json_of("s.json").at("requests"), 4);
  EXPECT_EQ(folder.json_of("s.json").at("settings").at("PACKAGE"), "a.farlod");
}

TEST_F(View, AnswersAsFarlodSvfDoes) {
  const std::string place = text_of(p_projected({-60.0, 0.0}));
  const std::size_t comma = place.find(',');
  EXPECT_EQ(ask({"at?x=" + place.substr(0, comma) + "&y=" + place.substr(comma + 1)}).exit_code, exit_interrupted + 15);
  folder.must("farlod-svf a.farlod -o at.csv --at " + place);
  EXPECT_THAT(folder.text_of("at.csv"), HasSubstr(folder.json_of("0").at("text").get<std::string>() + "\n"));
}

TEST_F(View, OtherMachinesAreServedIfAskedFor) {
  (void)ask({"view.json"}, "--listen 127.0.0.2 --quiet");
  EXPECT_THAT(folder.text_of("said.txt"), StartsWith("http://127.0.0.2:"));
  EXPECT_EQ(lines_of(folder.text_of("said.txt")).size(), 1U) << "--quiet: only what scripts need";
  EXPECT_THAT(folder.text_of("error.txt"), HasSubstr("other machines"));
}

TEST_F(View, ExportsFilesForAnyServer) {
  folder.must("farlod-view a.farlod --export page --summary s.json --quiet");
  EXPECT_FALSE(folder.json_of("page/view.json").at("can_answer").get<bool>());
  EXPECT_EQ(folder.json_of("s.json").at("tiles").get<std::size_t>(), lines_of(folder.run("find page -name '*.glb'").out).size());
  for (const char* name : {"page/index.html", "page/viewer.js", "page/viewer.css", "page/tileset.json",
                           "page/subtrees/0.0.0.subtree", "page/tiles/0/0/0.glb"})
    EXPECT_TRUE(folder.has(name)) << name;
  folder.must("farlod-view a.farlod --export page --quiet --threads 1 && cp -r page again");
  folder.must("farlod-view a.farlod --export page --quiet && diff -r page again");
}

TEST_F(View, DrawsResultsBesideThePackage) {
  folder.must("farlod-svf a.farlod -o svf.tif --grid 5 && farlod-svf a.farlod -o at.csv --at " +
              text_of(p_projected({-60.0, 0.0})));
  folder.must("farlod-pack town.geojson -o b.farlod --report problems.geojson --quiet");
  folder.must(
      "farlod-svf a.farlod -o walls.csv --surfaces all --spacing 5 && farlod-svf a.farlod -o walls.gpkg --surfaces all --spacing "
      "5");
  folder.must("farlod-view a.farlod svf.tif at.csv:svf problems.geojson walls.surfaces.csv walls.gpkg --export page --quiet");
  const json results = folder.json_of("page/view.json").at("results");
  ASSERT_EQ(results.size(), 5U);
  EXPECT_EQ(results[0].at("form"), "raster");
  EXPECT_EQ(folder.text_of("page/results/0").size(),
            results[0].at("width").get<std::size_t>() * results[0].at("height").get<std::size_t>() * sizeof(float));
  EXPECT_EQ(results[1].at("form"), "points");
  EXPECT_EQ(folder.json_of("page/results/1.json").size(), 1U);
  EXPECT_EQ(results[2].at("form"), "problems");
  EXPECT_EQ(results[3].at("form"), "surfaces");
  EXPECT_EQ(folder.json_of("page/results/3.json").size(), 36U) << "all buildings";
  EXPECT_EQ(folder.json_of("page/results/4.json"), folder.json_of("page/results/3.json")) << "whatever the format";
  EXPECT_EQ(results[4].at("count"), results[3].at("count"));
}

/// Writes the files that a page carries to the folder `carried`.
constexpr const char* unpack_page =
    "python3 -c 'import base64, gzip, os, re\n"
    "for name, text in re.findall(r\"<script type=.text/plain. data-file=.([^>]*).>([^<]*)</script>\", "
    "open(\"town.html\").read()):\n"
    "  os.makedirs(os.path.dirname(\"carried/\" + name), exist_ok=True)\n"
    "  open(\"carried/\" + name, \"wb\").write(gzip.decompress(base64.b64decode(text, validate=True)))'";

TEST_F(View, ExportsOnePageWithAllThatTheFolderHas) {
  folder.must("farlod-view a.farlod --export town.html --summary s.json --quiet");
  folder.must("farlod-view a.farlod --export page --quiet");
  folder.must(unpack_page);
  const std::string html = folder.text_of("town.html");
  for (const char* name : {"viewer.js", "viewer.css", "licences.txt"})
    EXPECT_THAT(html, HasSubstr(folder.text_of(std::string("page/") + name))) << name;
  for (const char* request : {"src=\"", "rel=\"preload\"", "rel=\"stylesheet\""})
    EXPECT_EQ(html.find(request), std::string::npos) << request;
  EXPECT_THAT(html, HasSubstr("Content-Security-Policy"));
  folder.must("rm page/index.html page/viewer.js page/viewer.css page/licences.txt && diff -r page carried");
  EXPECT_EQ(folder.json_of("s.json").at("bytes"), html.size());
  folder.must("farlod-view a.farlod --export again.HTM --quiet --threads 1 && cmp town.html again.HTM");
}

TEST_F(View, ASignalEndsAnExportAndLeavesNothing) {
  folder.must("farlod-city -o city.obj --size 1500 --quiet && farlod-pack city.obj -o city.farlod --crs EPSG:32632 --quiet");
  for (const char* name : {"city_page", "city.html"}) {
    const std::string begun = "until ls -A | grep -q '" + std::string(name) + ".'; do sleep .01; done";
    // What watches it has the core first, however busy the machine is: the export must not come to its end before the signal
    const Outcome outcome = folder.run("nice -n 19 farlod-view city.farlod --export " + std::string(name) + " & p=$!; " + begun +
                                       "; kill -TERM $p; wait $p");
    EXPECT_EQ(outcome.exit_code, exit_interrupted + 15);
    EXPECT_THAT(outcome.err, HasSubstr("interrupted. Nothing was written."));
    EXPECT_EQ(folder.run("ls -A | grep " + std::string(name)).out, "");
  }
}

TEST_F(View, ExportsReplaceNothingElse) {
  folder.must("mkdir mine && touch mine/photo.jpg");
  expect_refusal(folder.run("farlod-view a.farlod --export mine --quiet"), exit_unusable_input, {"mine"});
  EXPECT_TRUE(folder.has("mine/photo.jpg"));
  folder.must("mv mine mine.html");
  expect_refusal(folder.run("farlod-view a.farlod --export mine.html --quiet"), exit_unusable_input, {"mine.html", "folder"});
  EXPECT_TRUE(folder.has("mine.html/photo.jpg"));
}

TEST_F(View, WrongUseIsToldInOneLine) {
  expect_refusal(folder.run("farlod-view b.farlod"), exit_unusable_input, {"b.farlod", "farlod-pack"});
  expect_refusal(folder.run("farlod-view a.farlod nowhere.tif"), exit_unusable_input, {"nowhere.tif", "does not exist"});
  expect_refusal(folder.run("farlod-view a.farlod --port 99999"), exit_usage, {"--port"});
  expect_refusal(folder.run("farlod-view a.farlod --export x --port 8000"), exit_usage, {"--export", "--port"});
  expect_refusal(folder.run("farlod-view a.farlod --export nowhere/x.html"), exit_unusable_input, {"nowhere"});
  expect_refusal(folder.run("farlod-view a.farlod --listen 192.0.2.1"), exit_unusable_input, {"192.0.2.1"});
}

}  // namespace
}  // namespace farlod::acceptance
