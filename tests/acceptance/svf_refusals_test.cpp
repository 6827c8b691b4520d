// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "results/output_format.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

/// A command of farlod-svf that cannot be followed, and what the user must be told.
struct RefusedSvf {
  std::string name;
  std::string arguments;
  int exit_code;
  std::vector<std::string> said;
};
void PrintTo(const RefusedSvf& refused, std::ostream* out) { *out << "farlod-svf " << refused.arguments; }

std::string all_endings() {
  return endings_where([](const OutputFormat&) { return true; });
}

std::string name_of_refused(const testing::TestParamInfo<RefusedSvf>& info) { return info.param.name; }

class SvfRefuses : public testing::TestWithParam<RefusedSvf> {
 protected:
  SvfRefuses() {
    add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
    folder.must("mkdir no_package");
    folder.write("word.csv", "x,y\n500030,5500010\n500040,north\n");
    folder.write("short.csv", "x,y\n500030,5500010\n500040\n");
    folder.write("nameless.csv", "u,v\n1,2\n");
    folder.write("empty.csv", "");
    folder.write("headed.csv", "x,y\n");
    folder.write("pole.csv", "lon,lat\n9,95\n");
    folder.write("galaxy.csv", "x,y\n1e300,3\n");
    folder.write("typo.toml", "grid = 5\nrayz = 100\n");
  }
  WorkFolder folder;
};

TEST_P(SvfRefuses, InOneLine) {
  const std::vector<std::string> before = folder.names();
  expect_refusal(folder.run("farlod-svf " + GetParam().arguments), GetParam().exit_code, GetParam().said);
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    PackageReader, SvfRefuses,
    testing::Values(RefusedSvf{"Missing",
                               "lost.farlod -o o.csv --at 1,2",
                               exit_unusable_input,
                               {"lost.farlod is not a package", "no such folder", "farlod-pack"}},
                    RefusedSvf{"OtherFolder",
                               "no_package -o o.csv --at 1,2",
                               exit_unusable_input,
                               {"no_package is not a finished package", "manifest.json"}},
                    RefusedSvf{"File", "town.geojson -o o.csv --at 1,2", exit_unusable_input, {"town.geojson is not a package"}}),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Usage, SvfRefuses,
    testing::Values(
        RefusedSvf{"NoOutput", "a.farlod --at 1,2", exit_usage, {"--output is required"}},
        RefusedSvf{"NoPackage", "-o o.csv --at 1,2", exit_usage, {"PACKAGE is required"}},
        RefusedSvf{"UnknownEnding", "a.farlod -o o.no_such_format --at 1,2", exit_usage, {"o.no_such_format", all_endings()}},
        RefusedSvf{"NoEnding", "a.farlod -o o --at 1,2", exit_usage, {"\"o\"", all_endings()}},
        RefusedSvf{
            "NoReceivers", "a.farlod -o o.csv", exit_usage, {"--grid,--grid-like,--points,--along,--surfaces,--at", "required"}},
        RefusedSvf{"TwoKindsOfReceivers",
                   "a.farlod -o o.csv --at 1,2 --surfaces all",
                   exit_usage,
                   {"--grid,--grid-like,--points,--along,--surfaces,--at", "2 were given"}},
        RefusedSvf{"NoRays", "a.farlod -o o.csv --at 1,2 --rays 0", exit_usage, {"--rays", "1 to 10000000"}},
        RefusedSvf{"NegativeRays", "a.farlod -o o.csv --at 1,2 --rays -3", exit_usage, {"--rays", "1 to 10000000"}},
        RefusedSvf{"NegativeVerify", "a.farlod -o o.csv --at 1,2 --verify -4", exit_usage, {"--verify", "-4"}},
        RefusedSvf{"UnknownEngine",
                   "a.farlod -o o.csv --at 1,2 --engine magic",
                   exit_usage,
                   {"--engine: magic", "auto,horizon,rays,exact"}},
        RefusedSvf{"OneCoordinate", "a.farlod -o o.csv --at 1", exit_usage, {"--at: give X,Y or X,Y,Z"}},
        RefusedSvf{"CoordinateIsNoNumber", "a.farlod -o o.csv --at nan,2", exit_usage, {"--at", "nan,2"}},
        RefusedSvf{"ZeroStep", "a.farlod -o o.asc --grid 0", exit_usage, {"--grid: 0", "from 0.01 to 10000"}},
        RefusedSvf{"StepIsNoNumber", "a.farlod -o o.asc --grid nan", exit_usage, {"--grid: nan", "from 0.01 to 10000"}},
        RefusedSvf{
            "HeightIsNoNumber", "a.farlod -o o.asc --grid 5 --height nan", exit_usage, {"--height: nan", "from 0 to 10000"}},
        RefusedSvf{
            "HeightInSpace", "a.farlod -o o.asc --grid 5 --height 1e30", exit_usage, {"--height: 1e30", "from 0 to 10000"}},
        RefusedSvf{"SpacingIsNoNumber", "a.farlod -o o.csv --surfaces all --spacing nan", exit_usage, {"--spacing: nan"}},
        RefusedSvf{"BoxOfThreeNumbers", "a.farlod -o o.asc --grid 5 --bbox 1,2,3", exit_usage, {"--bbox", "X0,Y0,X1,Y1"}},
        RefusedSvf{"BoxWithACommaTooMany", "a.farlod -o o.asc --grid 5 --bbox 1,2,3,4,", exit_usage, {"--bbox", "X0,Y0,X1,Y1"}},
        RefusedSvf{"PlaceWithACommaTooMany", "a.farlod -o o.csv --at 1,2,", exit_usage, {"--at", "X,Y"}},
        RefusedSvf{"BoxInsideOut", "a.farlod -o o.asc --grid 5 --bbox 3,2,1,4", exit_usage, {"--bbox", "X0 < X1"}},
        RefusedSvf{"BoxBeyondAllMachines",
                   "a.farlod -o o.asc --grid 1 --bbox 0,0,1e300,1e300",
                   exit_usage,
                   {"--bbox", "nowhere on Earth"}},
        RefusedSvf{"BoxWithoutGrid", "a.farlod -o o.csv --at 1,2 --bbox 0,0,1,1", exit_usage, {"--bbox", "--grid"}},
        RefusedSvf{"PointsCrsWithoutPoints",
                   "a.farlod -o o.csv --at 1,2 --points-crs EPSG:4326",
                   exit_usage,
                   {"--points-crs", "--points"}},
        RefusedSvf{"PointsLayerWithoutPoints",
                   "a.farlod -o o.csv --at 1,2 --points-layer a",
                   exit_usage,
                   {"--points-layer", "--points"}},
        RefusedSvf{"PreviewWithoutGrid", "a.farlod -o o.csv --at 1,2 --preview p.png", exit_usage, {"--preview", "--grid"}},
        RefusedSvf{"HistogramOfOneValue",
                   "a.farlod -o o.csv --at 1,2 --histogram h.png",
                   exit_usage,
                   {"--histogram", "--grid, --points, --along and --surfaces"}},
        RefusedSvf{"HistogramIsNoPicture",
                   "a.farlod -o o.asc --grid 5 --histogram h.csv",
                   exit_usage,
                   {"--histogram", "h.csv", ".png, .svg, .pdf"}},
        RefusedSvf{"MapOfNoVerification",
                   "a.farlod -o o.asc --grid 5 --verify-map v.png",
                   exit_usage,
                   {"--verify-map", "give --verify"}},
        RefusedSvf{"MapOfOneVerification",
                   "a.farlod -o o.csv --at 1,2 --verify 1 --verify-map v.png",
                   exit_usage,
                   {"--verify-map", "--grid, --points, --along and --surfaces"}},
        RefusedSvf{"MapOfAVerificationIsNoPicture",
                   "a.farlod -o o.asc --grid 5 --verify 1 --verify-map v.asc",
                   exit_usage,
                   {"--verify-map", "v.asc", ".csv, .png, .svg, .pdf"}},
        RefusedSvf{"ProjectionOfATable",
                   "a.farlod -o o.csv --at 1,2 --projection equidistant",
                   exit_usage,
                   {"--projection", "picture of --at"}},
        RefusedSvf{"PreviewIsNoPicture",
                   "a.farlod -o o.asc --grid 5 --preview p.jpg",
                   exit_usage,
                   {"--preview", "p.jpg", ".png, .svg, .pdf"}},
        RefusedSvf{"NoMemory", "a.farlod -o o.csv --at 1,2 --memory-limit 0", exit_usage, {"--memory-limit", "0"}},
        RefusedSvf{"UnknownOptionInConfig", "a.farlod -o o.asc --config typo.toml", exit_usage, {"--config", "rayz"}}),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    City, SvfRefuses,
    testing::Values(
        RefusedSvf{
            "WithoutSurfaces", "a.farlod -o o.city.json --grid 5 --city town.geojson", exit_usage, {"--city", "--surfaces"}},
        RefusedSvf{
            "OtherEnding", "a.farlod -o o.csv --surfaces all --city town.geojson", exit_usage, {"-o", "ends in .city.json"}},
        RefusedSvf{"NotNamed", "a.farlod -o o.city.json --surfaces all", exit_usage, {"-o", "--city"}},
        RefusedSvf{
            "Bounds", "a.farlod -o o.city.json --surfaces all --city town.geojson --bounds", exit_usage, {"--bounds", "--city"}},
        RefusedSvf{"Missing",
                   "a.farlod -o o.city.json --surfaces all --city lost.city.json",
                   exit_unusable_input,
                   {"lost.city.json cannot be read"}},
        RefusedSvf{"AnotherFile",
                   "a.farlod -o o.city.json --surfaces all --city word.csv",
                   exit_unusable_input,
                   {"word.csv is not a file that a.farlod was made of", "checksum"}},
        RefusedSvf{"NoFolder",
                   "a.farlod -o lost/o.city.json --surfaces all --city town.geojson",
                   exit_unusable_input,
                   {"lost/o.city.json", "no folder lost"}},
        RefusedSvf{"NoPlaces",
                   "a.farlod -o o.city.json --surfaces all --city town.geojson",
                   exit_unusable_input,
                   {"town.geojson has no places for attributes", "CityGML and CityJSON"}}),
    name_of_refused);

/// Each format with the receivers that it is not for.
std::vector<RefusedSvf> formats_that_do_not_fit() {
  const std::string tables = endings_where([](const OutputFormat& f) { return f.holds_tables(); });
  const std::string pictures = endings_where([](const OutputFormat& f) { return f.is_picture; });
  const std::string rasters = endings_where([](const OutputFormat& f) { return f.raster_writer != nullptr; });
  std::vector<RefusedSvf> refused;
  for (const OutputFormat& format : output_formats()) {
    const std::string ending(format.endings[0]), name = ending.substr(1), command = "a.farlod -o o" + ending;
    if (format.raster_writer == nullptr)
      refused.push_back({"Grid_" + name, command + " --grid 5", exit_usage, {"-o", "--grid makes a raster", ending, rasters}});
    if (!format.holds_tables())
      for (const std::string receivers : {"--points word.csv", "--at 1,2", "--surfaces all"}) {
        // The sky above a place is a picture
        if (format.is_picture && receivers == "--at 1,2") continue;
        refused.push_back({receivers.substr(2, receivers.find(' ') - 2) + "_" + name,
                           command + " " + receivers,
                           exit_usage,
                           {"-o", "only --grid makes a raster", tables}});
      }
    if (!format.is_picture)
      refused.push_back({"Preview_" + name,
                         "a.farlod -o o.asc --grid 5 --preview p" + ending,
                         exit_usage,
                         {"--preview", "p" + ending, pictures}});
  }
  return refused;
}
INSTANTIATE_TEST_SUITE_P(Formats, SvfRefuses, testing::ValuesIn(formats_that_do_not_fit()), name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Points, SvfRefuses,
    testing::Values(
        RefusedSvf{"Missing", "a.farlod -o o.csv --points lost.csv", exit_unusable_input, {"lost.csv", "cannot be read"}},
        RefusedSvf{
            "Word", "a.farlod -o o.csv --points word.csv", exit_unusable_input, {"word.csv:3", "\"north\" is not a number"}},
        RefusedSvf{"ShortRow", "a.farlod -o o.csv --points short.csv", exit_unusable_input, {"short.csv:3", "ends before y"}},
        RefusedSvf{
            "NamelessColumns", "a.farlod -o o.csv --points nameless.csv", exit_unusable_input, {"nameless.csv:1", "x and y"}},
        RefusedSvf{"Empty", "a.farlod -o o.csv --points empty.csv", exit_unusable_input, {"empty.csv", "no points"}},
        RefusedSvf{"LayerOfATable",
                   "a.farlod -o o.csv --points word.csv --points-layer a",
                   exit_unusable_input,
                   {"word.csv", "no layers"}},
        RefusedSvf{"HeaderAlone", "a.farlod -o o.csv --points headed.csv", exit_unusable_input, {"headed.csv", "no points"}},
        RefusedSvf{
            "BeyondAllMaps", "a.farlod -o o.csv --points galaxy.csv", exit_unusable_input, {"point 1", "nowhere on Earth"}},
        RefusedSvf{"AtBeyondAllMaps", "a.farlod -o o.csv --at 1e12,1e12", exit_unusable_input, {"point 1", "nowhere on Earth"}},
        RefusedSvf{
            "AtInSpace", "a.farlod -o o.csv --at 500000,5500000,1e30", exit_unusable_input, {"point 1", "nowhere on Earth"}}),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(Output, SvfRefuses,
                         testing::Values(RefusedSvf{"NoFolder",
                                                    "a.farlod -o lost/o.csv --at 500030,5500010",
                                                    exit_unusable_input,
                                                    {"lost/o.csv", "no folder lost"}},
                                         RefusedSvf{"NoFolderForPreview",
                                                    "a.farlod -o o.asc --grid 5 --preview lost/p.png",
                                                    exit_unusable_input,
                                                    {"lost/p.png", "no folder lost"}},
                                         RefusedSvf{"NoFolderForSummary",
                                                    "a.farlod -o o.asc --grid 5 --summary lost/s.json",
                                                    exit_unusable_input,
                                                    {"lost/s.json", "no folder lost"}},
                                         RefusedSvf{"FolderIsAFile",
                                                    "a.farlod -o town.geojson/o.csv --at 500030,5500010",
                                                    exit_unusable_input,
                                                    {"town.geojson/o.csv"}}),
                         name_of_refused);

#ifdef FARLOD_WITH_GDAL
INSTANTIATE_TEST_SUITE_P(Gdal, SvfRefuses,
                         testing::Values(RefusedSvf{"BeyondThePole",
                                                    "a.farlod -o o.csv --points pole.csv --points-crs EPSG:4326",
                                                    exit_unusable_input,
                                                    {"point 1 at (9, 95)", "x is the longitude"}},
                                         RefusedSvf{"PolygonsForPoints",
                                                    "a.farlod -o o.csv --points town.geojson",
                                                    exit_unusable_input,
                                                    {"town.geojson", "holds no points"}},
                                         RefusedSvf{"MissingVectorFile",
                                                    "a.farlod -o o.csv --points lost.gpkg",
                                                    exit_unusable_input,
                                                    {"lost.gpkg", "cannot be read"}},
                                         RefusedSvf{"UnknownPointsCrs",
                                                    "a.farlod -o o.csv --points pole.csv --points-crs EPSG:99999",
                                                    exit_unusable_input,
                                                    {"EPSG:99999", "not known", "EPSG:4326"}}),
                         name_of_refused);
#endif

TEST(SvfAnswersFromOutside, ABoxBesideTheCityIsAllNoData) {
  const WorkFolder folder;
  add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 5 --bbox 0,0,50,50 --summary s.json");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, testing::HasSubstr("No receiver has an answer"));
  EXPECT_EQ(folder.json_of("s.json").at("nodata"), 100);
  EXPECT_TRUE(folder.json_of("s.json").at("svf").at("mean").is_null());
}

}  // namespace
}  // namespace farlod::acceptance
