// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <functional>

#include "tests/acceptance/refused_command.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::acceptance {
namespace {

namespace fs = std::filesystem;

RefusedCommand wrong_packing(const std::string& name, const std::string& options, const std::vector<std::string>& said) {
  return wrong_usage(name, "town.geojson -o a.farlod " + options, said);
}
RefusedCommand unusable_packing(const std::string& name, const std::string& options, const std::vector<std::string>& said) {
  return unusable(name, "town.geojson -o a.farlod " + options, said);
}

constexpr const char* gml_head = "<?xml version=\"1.0\"?>\n<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\">";

/// A house of 8 m × 6 m × 7 m without a transform.
constexpr const char* house_in_millimetres =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"},)"
    R"("CityObjects":{"house":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":)"
    R"([[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]}]}},)"
    R"("vertices":[[690000,5335000,0],[698000,5335000,0],[698000,5341000,0],[690000,5341000,0],)"
    R"([690000,5335000,7000],[698000,5335000,7000],[698000,5341000,7000],[690000,5341000,7000]]})";

class PackRefuses : public testing::TestWithParam<RefusedCommand> {
 protected:
  PackRefuses() {
    folder.write("town.geojson", footprints_geojson({{"block", {}, 20.0, 10.0}}));
    folder.write("box.obj", box_obj());
    folder.write("cut.gml", std::string(gml_head) + "<cityObjectMember>");
    folder.write("prose.gml", "not XML at all");
    folder.write("empty.gml", "");
    folder.write("empty.obj", "");
    folder.write("forest.gml", std::string(gml_head) + "</CityModel>");
    folder.write(
        "forest.city.json",
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})");
    folder.write("cut.city.json", R"({"type":"CityJSON","vers)");
    folder.write("nothing.geojson", R"({"type":"FeatureCollection","features":[]})");
    folder.write("text.txt", "no table");
    folder.write("alone.city.jsonl", R"({"type":"CityJSONFeature","id":"a","CityObjects":{},"vertices":[]})");
    folder.write("huge.city.json", house_in_millimetres);
    std::vector<Block> blocks = small_town();
    for (Block& block : blocks) block.height_m += 120.0;
    std::string elevations = footprints_geojson(blocks);
    for (std::size_t at = 0; (at = elevations.find("height", at)) != elevations.npos;) elevations.replace(at, 6, "nhn");
    folder.write("elevations.geojson", elevations);
    folder.write("tokyo.csv", "lon,lat,height\n139.76,35.68,9\n139.77,35.68,9\n");
    folder.write("perth.csv", "lon,lat,height\n115.86,-31.95,9\n");
    folder.write("typo.toml", "cel = 40\n");
  }
  WorkFolder folder;
};

TEST_P(PackRefuses, InOneLine) {
  expect_refusal(folder.run("farlod-pack " + GetParam().arguments), GetParam().exit_code, GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(
    Files, PackRefuses,
    testing::Values(unusable("Missing", "lost.gml -o a.farlod", {"lost.gml does not exist", "Check the path"}),
                    unusable("CutXml", "cut.gml -o a.farlod", {"cut.gml is not well-formed XML", "line 2", "cut short?"}),
                    unusable("NotXml", "prose.gml -o a.farlod", {"prose.gml is not well-formed XML", "line 1", "XML checker"}),
                    unusable("EmptyXml", "empty.gml -o a.farlod", {"empty.gml is empty: 0 bytes"}),
                    unusable("EmptyObj", "empty.obj -o a.farlod", {"empty.obj is empty: 0 bytes"}),
                    unusable("PlainText", "text.txt -o a.farlod", {"text.txt is a plain text, which is not read"}),
                    unusable("CutJson", "cut.city.json -o a.farlod", {"cut.city.json is not JSON", "line 1", "cjval"}),
                    unusable("GmlWithoutBuildings", "forest.gml -o a.farlod", {"forest.gml holds no Building", "another theme"}),
                    unusable("CityJsonWithoutBuildings", "forest.city.json -o a.farlod", {"forest.city.json holds no Building"}),
                    unusable("FootprintsWithoutFeatures", "nothing.geojson -o a.farlod", {"nothing.geojson"}),
                    unusable("OneOfTwoIsMissing", "town.geojson lost.gml -o a.farlod", {"lost.gml does not exist"}),
                    unusable_packing("NoTrees", "--trees lost.csv", {"lost.csv", "does not exist"}),
                    unusable("TreesAreNoInventory", "town.geojson --trees text.txt -o a.farlod --quiet", {"text.txt"}),
                    unusable_packing("TreesOfAnotherPlace", "--trees tokyo.csv --quiet",
                                     {"tokyo.csv: does not meet the city", "no tree of 2 stands", "CRS"}),
                    unusable_packing("TreesOfTheOtherHemisphere", "--trees perth.csv --quiet",
                                     {"perth.csv: does not meet the city", "no tree of 1 stands"}),
                    unusable("CanopyIsNoRaster", "town.geojson --canopy town.geojson -o a.farlod --quiet",
                             {"town.geojson", "is not a raster of the heights of crowns"}),
                    wrong_packing("TrunksWithoutCanopy", "--trunk a.tif", {"--trunk", "--canopy"}),
                    wrong_packing("TrunksAboveCrowns", "--trunk-ratio 1.5", {"--trunk-ratio"}),
                    wrong_packing("GroundWithoutAName", "--ground-names lot,,road", {"--ground-names", "empty name"}),
                    wrong_packing("TreesWithoutAName", "--trees ''", {"--trees", "empty"}),
                    unusable_packing("NoTerrain", "--terrain lost.tif", {"lost.tif"}),
                    unusable_packing("TerrainIsNoRaster", "--terrain town.geojson",
                                     {"town.geojson: is not a raster", "GeoTIFF"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Meaning, PackRefuses,
    testing::Values(
        unusable("NoCrs", "box.obj -o a.farlod", {"box.obj does not say its CRS", "--crs EPSG:n"}),
        unusable("UnknownCrs", "box.obj --crs EPSG:99999 -o a.farlod", {"--crs EPSG:99999", "box.obj", "no such CRS"}),
        unusable("CrsInWords", "box.obj --crs Germany -o a.farlod", {"--crs Germany", "give EPSG:n"}),
        unusable_packing("UnknownOutCrs", "--out-crs EPSG:99999", {"--out-crs EPSG:99999"}),
        unusable_packing("OutCrsInDegrees", "--out-crs EPSG:4326", {"EPSG:4326", "not projected", "UTM"}),
        unusable_packing("OutCrsOfAFarZone", "--out-crs EPSG:32618",
                         {"EPSG:32618", "at the city its metres are off", "such as EPSG:32632 (WGS 84 / UTM zone 32N)"}),
        unusable_packing("NoSuchHeightField", "--height-field tall", {"no field \"tall\"", "height, floors", "--height-field"}),
        unusable("ElevationsAsHeights", "elevations.geojson --height-field nhn -o a.farlod",
                 {"elevations.geojson: nhn holds elevations", "--roof-field nhn", "--base-field"}),
        unusable("MillimetresAsMetres", "huge.city.json -o a.farlod",
                 {"huge.city.json: no building is this large", "8000 m wide", "\"transform\", which may be missing"}),
        unusable("FeatureWithoutItsHeader", "alone.city.jsonl -o a.farlod", {"alone.city.jsonl holds a CityJSONFeature"}),
        unusable_packing("NoSuchBaseField", "--base-field sea", {"no field \"sea\"", "height, floors", "--base-field"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Usage, PackRefuses,
    testing::Values(wrong_usage("NoOutput", "town.geojson", {"--output is required"}),
                    wrong_usage("NoInput", "-o a.farlod", {"INPUT is required"}),
                    wrong_usage("EmptyOutput", "town.geojson -o ''", {"-o", "name is empty", "NAME.farlod"}),
                    wrong_packing("EvenNeighborhood", "--neighborhood 4", {"--neighborhood: 4 is even", "odd"}),
                    wrong_packing("ZeroNeighborhood", "--neighborhood 0", {"--neighborhood", "1 to 999"}),
                    wrong_packing("NegativeCell", "--cell -5", {"--cell: -5", "from 0.5 to 10000"}),
                    wrong_packing("ZeroCell", "--cell 0", {"--cell: 0", "from 0.5 to 10000"}),
                    wrong_packing("HugeCell", "--cell 1e9", {"--cell: 1e9", "from 0.5 to 10000"}),
                    wrong_packing("CellIsNoNumber", "--cell nan", {"--cell: nan", "from 0.5 to 10000"}),
                    wrong_packing("NegativeHeight", "--default-height -3", {"--default-height: -3"}),
                    wrong_packing("AlignInWords", "--align north", {"--align: \"north\"", "auto, none, or degrees"}),
                    wrong_packing("AlignBeyondATurn", "--align 1e9", {"--align", "full turn"}),
                    wrong_usage("OriginOfOneNumber", "box.obj -o a.farlod --origin 1", {"--origin: give X,Y or X,Y,Z"}),
                    wrong_packing("UnknownOption", "--frobnicate", {"--frobnicate"}),
                    wrong_packing("UnknownOptionInConfig", "--config typo.toml", {"--config", "cel"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Output, PackRefuses,
    testing::Values(
        unusable("FolderBelowAFile", "town.geojson -o box.obj/a.farlod", {"box.obj/a.farlod cannot be written"}),
        unusable("FolderIsAFile", "town.geojson -o box.obj --force", {"box.obj is a file", "-o"}),
        unusable("ReportInNoFolder", "town.geojson -o a.farlod --report lost/r.json", {"lost/r.json", "no folder lost"}),
        unusable("SummaryInNoFolder", "town.geojson -o a.farlod --summary lost/s.json", {"lost/s.json", "no folder lost"})),
    name_of_refused);

class PackGuardsFolders : public testing::Test {
 protected:
  PackGuardsFolders() { folder.write("town.geojson", footprints_geojson({{"block", {}, 20.0, 10.0}})); }
  WorkFolder folder;
};

TEST_F(PackGuardsFolders, AnExistingPackageIsReplacedOnlyByForce) {
  folder.must("farlod-pack town.geojson -o a.farlod");
  const std::string before = folder.text_of("a.farlod/manifest.json");
  expect_refusal(folder.run("farlod-pack town.geojson --cell 25 -o a.farlod"), exit_unusable_input,
                 {"a.farlod exists already", "--force"});
  EXPECT_EQ(folder.text_of("a.farlod/manifest.json"), before);
  folder.must("farlod-pack town.geojson --cell 25 -o a.farlod --force");
  EXPECT_NE(folder.text_of("a.farlod/manifest.json"), before);
}

TEST_F(PackGuardsFolders, ForeignFilesStayEvenWithForce) {
  folder.must("mkdir thesis");
  folder.write("thesis/chapter.txt", "the work of three years");
  for (const char* force : {"", " --force"}) {
    const Outcome outcome = folder.run(std::string("farlod-pack town.geojson -o thesis") + force);
    expect_refusal(outcome, exit_unusable_input, {"thesis holds chapter.txt", "choose another folder"});
    EXPECT_EQ(folder.text_of("thesis/chapter.txt"), "the work of three years");
  }
  EXPECT_FALSE(folder.has("thesis/manifest.json"));
}

TEST_F(PackGuardsFolders, NothingIsLeftOfACityThatCannotBeRead) {
  for (const char* input : {"town.geojson lost.gml", "town.geojson --terrain lost.tif", "town.geojson --out-crs EPSG:4326"}) {
    EXPECT_EQ(folder.run(std::string("farlod-pack -o a.farlod ") + input).exit_code, exit_unusable_input) << input;
    EXPECT_FALSE(folder.has("a.farlod")) << input;
  }
}

TEST_F(PackGuardsFolders, AnInputThatCannotBeReadCostsNoPackage) {
  folder.must("farlod-pack town.geojson -o a.farlod");
  EXPECT_EQ(folder.run("farlod-pack town.geojson --terrain lost.tif -o a.farlod --force").exit_code, exit_unusable_input);
  folder.must("farlod-svf a.farlod -o o.asc --grid 5");
}

TEST_F(PackGuardsFolders, TheReportIsWrittenWhenNoBuildingIsLeft) {
  std::string flat = footprints_geojson({{"flat", {}, 20.0, 0.0}});
  flat.replace(flat.find("floors"), 6, "number");  // storeys would stand in for a height of 0
  folder.write("flat.geojson", flat);
  expect_refusal(folder.run("farlod-pack flat.geojson -o a.farlod --report r.json"), exit_unusable_input,
                 {"flat.geojson holds no usable building"});
  ASSERT_EQ(folder.json_of("r.json").size(), 1U);
  EXPECT_EQ(folder.json_of("r.json")[0].at("code"), 109);
}

/// A small package, and the names of its files.
class DamagedPackage : public testing::Test {
 protected:
  DamagedPackage() {
    add_packed_town(folder, "small_town", small_town());
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("a.farlod")))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder.path("")).string());
  }
  [[nodiscard]] Outcome evaluate() const { return folder.run("farlod-svf a.farlod -o o.asc --grid 20"); }
  void expect_damage(const std::vector<std::string>& said) const {
    expect_refusal(evaluate(), exit_damaged_package, said);
    EXPECT_FALSE(folder.has("o.asc"));
  }
  /// Applies a change to each file of that name.
  void change(const std::string& name, const std::function<void(const std::string&)>& change_file) const {
    std::size_t changed = 0;
    for (const std::string& file : files) {
      if (fs::path(file).filename() != name) continue;
      change_file(file);
      ++changed;
    }
    ASSERT_GT(changed, 0U) << name;
  }
  void cut(const std::string& file, std::uintmax_t bytes) const { fs::resize_file(folder.path(file), bytes); }
  void edit_manifest(const std::string& from, const std::string& to) const {
    std::string text = folder.text_of("a.farlod/manifest.json");
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    folder.write("a.farlod/manifest.json", scenes::sealed(text.replace(place, from.size(), to)));
  }

  WorkFolder folder;
  std::vector<std::string> files;
};

TEST_F(DamagedPackage, WholeItIsRead) { EXPECT_EQ(evaluate().exit_code, exit_done); }

TEST_F(DamagedPackage, TilesCutShort) {
  change("tiles.bin", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"tiles.bin is damaged", "bytes", "pack the city again"});
}

TEST_F(DamagedPackage, TilesOfNoBytes) {
  change("tiles.bin", [this](const std::string& file) { cut(file, 0); });
  expect_damage({"tiles.bin is damaged", "0 bytes"});
}

TEST_F(DamagedPackage, TilesMissing) {
  change("tiles.bin", [this](const std::string& file) { fs::remove(folder.path(file)); });
  expect_damage({"tiles.bin"});
}

TEST_F(DamagedPackage, OneBitOfTheTilesTurned) {
  change("tiles.bin", [this](const std::string& file) {
    std::string bytes = folder.text_of(file);
    char& middle = bytes[bytes.size() / 2];
    middle = static_cast<char>(middle ^ 1);
    folder.write(file, bytes);
  });
  expect_damage({"tiles.bin is damaged", "checksum", "pack the city again"});
}

TEST_F(DamagedPackage, FarMapsCutShort) {
  change("far.exr", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"far.exr is damaged", "bytes", "pack the city again"});
}

TEST_F(DamagedPackage, FarMapsMissing) {
  change("far.exr", [this](const std::string& file) { fs::remove(folder.path(file)); });
  expect_damage({"far.exr"});
}

TEST_F(DamagedPackage, ManifestCutShort) {
  change("manifest.json", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"manifest.json is damaged", "pack the city again"});
}

TEST_F(DamagedPackage, ManifestWithAnImpossibleCell) {
  edit_manifest("\"cell_m\": 150.0", "\"cell_m\": -150.0");
  expect_damage({"manifest.json is damaged", "cell edge"});
}

TEST_F(DamagedPackage, ManifestWithAnEvenNeighborhood) {
  edit_manifest("\"neighborhood\": 3", "\"neighborhood\": 4");
  expect_damage({"manifest.json is damaged", "neighborhood"});
}

TEST_F(DamagedPackage, ManifestOfSomethingElse) {
  folder.write("a.farlod/manifest.json", "{\"name\": \"a web application\"}");
  expect_damage({"manifest.json is damaged"});
}

TEST_F(DamagedPackage, OneDigitOfTheManifestsOriginChanged) {
  // Within the range of origins: nothing but the checksum tells
  std::string text = folder.text_of("a.farlod/manifest.json");
  char& digit = text[text.find_first_of("0123456789", text.find("\"origin_m\""))];
  digit = digit == '5' ? '4' : '5';
  folder.write("a.farlod/manifest.json", text);
  expect_damage({"manifest.json is damaged", "checksum"});
  const Outcome checked = folder.run("farlod-info a.farlod --check");
  expect_refusal(checked, exit_damaged_package, {"manifest.json is damaged", "checksum"});
}

TEST_F(DamagedPackage, ANewerVersionIsNoDamage) {
  edit_manifest("\"version\": 10", "\"version\": 13");
  expect_refusal(evaluate(), exit_unusable_input,
                 {"manifest.json has format version 13", "reads versions 8 to 12", "newer release"});
}

TEST_F(DamagedPackage, AnOlderVersionIsNoDamage) {
  const std::string text = folder.text_of("a.farlod/manifest.json");
  for (const std::string version : {"5", "6", "7"}) {
    folder.write("a.farlod/manifest.json", text);
    edit_manifest("\"version\": 10", "\"version\": " + version);
    const std::vector<std::string> said{"manifest.json has format version " + version, "reads versions 8 to 12",
                                        "Pack the city again"};
    expect_refusal(evaluate(), exit_unusable_input, said);
    expect_refusal(folder.run("farlod-info a.farlod --check"), exit_unusable_input, said);
  }
}

TEST_F(DamagedPackage, AnInterruptedPackingIsNoDamage) {
  fs::remove(folder.path("a.farlod/manifest.json"));
  expect_refusal(evaluate(), exit_unusable_input, {"a.farlod is not a finished package", "interrupted", "Pack the city again"});
}

}  // namespace
}  // namespace farlod::acceptance
