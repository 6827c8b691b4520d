// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <functional>

#include "farlod/error.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::acceptance {
namespace {

namespace fs = std::filesystem;

/// A command of farlod-pack that cannot be followed, and what the user must be told.
struct Refused {
  const char* name;
  const char* arguments;
  int exit_code;
  std::vector<std::string> said;
};
void PrintTo(const Refused& refused, std::ostream* out) { *out << "farlod-pack " << refused.arguments; }

std::string name_of(const testing::TestParamInfo<Refused>& info) { return info.param.name; }

constexpr const char* gml_head = "<?xml version=\"1.0\"?>\n<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\">";

class PackRefuses : public testing::TestWithParam<Refused> {
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
    folder.write("typo.toml", "cel = 40\n");
  }
  WorkFolder folder;
};

TEST_P(PackRefuses, InOneLine) {
  expect_refusal(folder.run(std::string("farlod-pack ") + GetParam().arguments), GetParam().exit_code, GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(
    Files, PackRefuses,
    testing::Values(
        Refused{"Missing", "lost.gml -o a.farlod", exit_unusable_input, {"lost.gml does not exist", "Check the path"}},
        Refused{"CutXml", "cut.gml -o a.farlod", exit_unusable_input, {"cut.gml is not well-formed XML", "line 2", "cut short?"}},
        Refused{"NotXml",
                "prose.gml -o a.farlod",
                exit_unusable_input,
                {"prose.gml is not well-formed XML", "line 1", "XML checker"}},
        Refused{"EmptyXml", "empty.gml -o a.farlod", exit_unusable_input, {"empty.gml is empty: 0 bytes"}},
        Refused{"EmptyObj", "empty.obj -o a.farlod", exit_unusable_input, {"empty.obj is empty: 0 bytes"}},
        Refused{"CutJson", "cut.city.json -o a.farlod", exit_unusable_input, {"cut.city.json is not JSON", "line 1", "cjval"}},
        Refused{"GmlWithoutBuildings",
                "forest.gml -o a.farlod",
                exit_unusable_input,
                {"forest.gml holds no Building", "another theme"}},
        Refused{"CityJsonWithoutBuildings",
                "forest.city.json -o a.farlod",
                exit_unusable_input,
                {"forest.city.json holds no Building"}},
        Refused{"FootprintsWithoutFeatures", "nothing.geojson -o a.farlod", exit_unusable_input, {"nothing.geojson"}},
        Refused{"OneOfTwoIsMissing", "town.geojson lost.gml -o a.farlod", exit_unusable_input, {"lost.gml does not exist"}},
        Refused{"NoTrees", "town.geojson --trees lost.csv -o a.farlod", exit_unusable_input, {"lost.csv", "does not exist"}},
        Refused{"TreesAreNoInventory", "town.geojson --trees text.txt -o a.farlod --quiet", exit_unusable_input, {"text.txt"}},
        Refused{"CanopyIsNoRaster",
                "town.geojson --canopy town.geojson -o a.farlod --quiet",
                exit_unusable_input,
                {"town.geojson", "is not a raster of the heights of crowns"}},
        Refused{"TrunksWithoutCanopy", "town.geojson --trunk a.tif -o a.farlod", exit_usage, {"--trunk", "--canopy"}},
        Refused{"TrunksAboveCrowns", "town.geojson --trunk-ratio 1.5 -o a.farlod", exit_usage, {"--trunk-ratio"}},
        Refused{"TreesWithoutAName", "town.geojson --trees '' -o a.farlod", exit_usage, {"--trees", "empty"}},
        Refused{"NoTerrain", "town.geojson --terrain lost.tif -o a.farlod", exit_unusable_input, {"lost.tif"}},
        Refused{"TerrainIsNoRaster",
                "town.geojson --terrain town.geojson -o a.farlod",
                exit_unusable_input,
                {"town.geojson: is not a raster", "GeoTIFF"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Meaning, PackRefuses,
    testing::Values(
        Refused{"NoCrs", "box.obj -o a.farlod", exit_unusable_input, {"box.obj does not say its CRS", "--crs EPSG:n"}},
        Refused{"UnknownCrs",
                "box.obj --crs EPSG:99999 -o a.farlod",
                exit_unusable_input,
                {"--crs EPSG:99999", "box.obj", "no such CRS"}},
        Refused{"CrsInWords", "box.obj --crs Germany -o a.farlod", exit_unusable_input, {"--crs Germany", "give EPSG:n"}},
        Refused{"UnknownOutCrs", "town.geojson --out-crs EPSG:99999 -o a.farlod", exit_unusable_input, {"--out-crs EPSG:99999"}},
        Refused{"OutCrsInDegrees",
                "town.geojson --out-crs EPSG:4326 -o a.farlod",
                exit_unusable_input,
                {"EPSG:4326", "not projected", "UTM"}},
        Refused{"NoSuchHeightField",
                "town.geojson --height-field tall -o a.farlod",
                exit_unusable_input,
                {"no field \"tall\"", "height, floors", "--height-field"}},
        Refused{"NoSuchBaseField",
                "town.geojson --base-field sea -o a.farlod",
                exit_unusable_input,
                {"no field \"sea\"", "height, floors", "--base-field"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Usage, PackRefuses,
    testing::Values(
        Refused{"NoOutput", "town.geojson", exit_usage, {"--output is required"}},
        Refused{"NoInput", "-o a.farlod", exit_usage, {"INPUT is required"}},
        Refused{"EmptyOutput", "town.geojson -o ''", exit_usage, {"-o", "name is empty", "NAME.farlod"}},
        Refused{
            "EvenNeighborhood", "town.geojson -o a.farlod --neighborhood 4", exit_usage, {"--neighborhood: 4 is even", "odd"}},
        Refused{"ZeroNeighborhood", "town.geojson -o a.farlod --neighborhood 0", exit_usage, {"--neighborhood", "1 to 999"}},
        Refused{"NegativeCell", "town.geojson -o a.farlod --cell -5", exit_usage, {"--cell: -5", "from 0.5 to 10000"}},
        Refused{"ZeroCell", "town.geojson -o a.farlod --cell 0", exit_usage, {"--cell: 0", "from 0.5 to 10000"}},
        Refused{"HugeCell", "town.geojson -o a.farlod --cell 1e9", exit_usage, {"--cell: 1e9", "from 0.5 to 10000"}},
        Refused{"CellIsNoNumber", "town.geojson -o a.farlod --cell nan", exit_usage, {"--cell: nan", "from 0.5 to 10000"}},
        Refused{"NegativeHeight", "town.geojson -o a.farlod --default-height -3", exit_usage, {"--default-height: -3"}},
        Refused{"AlignInWords",
                "town.geojson -o a.farlod --align north",
                exit_usage,
                {"--align: \"north\"", "auto, none, or degrees"}},
        Refused{"AlignBeyondATurn", "town.geojson -o a.farlod --align 1e9", exit_usage, {"--align", "full turn"}},
        Refused{"OriginOfOneNumber", "box.obj -o a.farlod --origin 1", exit_usage, {"--origin: give X,Y or X,Y,Z"}},
        Refused{"UnknownOption", "town.geojson -o a.farlod --frobnicate", exit_usage, {"--frobnicate"}},
        Refused{"UnknownLod", "town.geojson -o a.farlod --lod 7", exit_usage, {"--lod: 7", "best,0,1,2,3"}},
        Refused{"NoSuchConfig", "town.geojson -o a.farlod --config lost.toml", exit_usage, {"lost.toml"}},
        Refused{"UnknownOptionInConfig", "town.geojson -o a.farlod --config typo.toml", exit_usage, {"--config", "cel"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Output, PackRefuses,
    testing::Values(Refused{"FolderBelowAFile",
                            "town.geojson -o box.obj/a.farlod",
                            exit_unusable_input,
                            {"box.obj/a.farlod cannot be written"}},
                    Refused{"FolderIsAFile", "town.geojson -o box.obj --force", exit_unusable_input, {"box.obj is a file", "-o"}},
                    Refused{"ReportInNoFolder",
                            "town.geojson -o a.farlod --report lost/r.json",
                            exit_unusable_input,
                            {"lost/r.json", "no folder lost"}},
                    Refused{"SummaryInNoFolder",
                            "town.geojson -o a.farlod --summary lost/s.json",
                            exit_unusable_input,
                            {"lost/s.json", "no folder lost"}}),
    name_of);

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
  folder.write("flat.geojson", footprints_geojson({{"flat", {}, 20.0, 0.0}}));
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
  edit_manifest("\"version\": 10", "\"version\": 11");
  expect_refusal(evaluate(), exit_unusable_input,
                 {"manifest.json has format version 11", "reads versions 8 to 10", "newer release"});
}

TEST_F(DamagedPackage, AnOlderVersionIsNoDamage) {
  const std::string text = folder.text_of("a.farlod/manifest.json");
  for (const std::string version : {"5", "6", "7"}) {
    folder.write("a.farlod/manifest.json", text);
    edit_manifest("\"version\": 10", "\"version\": " + version);
    const std::vector<std::string> said{"manifest.json has format version " + version, "reads versions 8 to 10",
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
