// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "results/output_format.hpp"
#include "tests/acceptance/refused_command.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

RefusedCommand wrong_at(const std::string& name, const std::string& options, const std::vector<std::string>& said) {
  return wrong_usage(name, "a.farlod -o o.csv --at 1,2 " + options, said);
}
RefusedCommand wrong_grid(const std::string& name, const std::string& options, const std::vector<std::string>& said) {
  return wrong_usage(name, "a.farlod -o o.asc --grid 5 " + options, said);
}
RefusedCommand unusable_points(const std::string& name, const std::string& file, const std::vector<std::string>& said) {
  return unusable(name, "a.farlod -o o.csv --points " + file, said);
}

/// Of the formats for a single place, of those for maps, and of those for maps with more than one quantity.
std::string endings_of_a_place() {
  return endings_where([](const OutputFormat& f) { return f.holds_tables() || f.is_picture; });
}
std::string endings_of_tables() {
  return endings_where([](const OutputFormat& f) { return f.holds_tables(); });
}
std::string endings_of_tables_with_room() {
  return endings_where([](const OutputFormat& f) { return f.holds_tables() && f.holds_bounds; });
}
std::string endings_of_maps_with_room() {
  return endings_where([](const OutputFormat& f) { return f.holds_rasters() && f.holds_bounds; });
}

class SvfRefuses : public testing::TestWithParam<RefusedCommand> {
 protected:
  SvfRefuses() {
    add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
    folder.write("word.csv", "x,y\n500030,5500010\n500040,north\n");
    folder.write("short.csv", "x,y\n500030,5500010\n500040\n");
    folder.write("nameless.csv", "u,v\n1,2\n");
    folder.write("empty.csv", "");
    folder.write("headed.csv", "x,y\n");
    folder.write("pole.csv", "lon,lat\n9,95\n");
    folder.write("galaxy.csv", "x,y\n1e300,3\n");
  }
  WorkFolder folder;
};

TEST_P(SvfRefuses, InOneLine) {
  const std::vector<std::string> before = folder.names();
  expect_refusal(folder.run("farlod-svf " + GetParam().arguments), GetParam().exit_code, GetParam().said);
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Usage, SvfRefuses,
    testing::Values(
        wrong_usage("NoOutput", "a.farlod --at 1,2", {"--output is required"}),
        wrong_usage("UnknownEnding", "a.farlod -o o.no_such_format --at 1,2", {"o.no_such_format", endings_of_a_place() + "."}),
        wrong_usage("UnknownEndingOfSurfaces", "a.farlod -o o.shp --surfaces all",
                    {"o.shp", "choose one of " + endings_of_tables() + "."}),
        wrong_usage("UnknownEndingOfBounds", "a.farlod -o o.shp --points p.csv --bounds",
                    {"o.shp", "choose one of " + endings_of_tables_with_room() + "."}),
        wrong_usage("UnknownEndingOfQuantities", "a.farlod -o o.shp --grid 5 --quantity svf_solid,directional",
                    {"o.shp", "choose one of " + endings_of_maps_with_room() + "."}),
        wrong_usage("ATableOfAMapWithBounds", "a.farlod -o o.csv --grid 5 --bounds",
                    {".csv cannot hold", "choose one of " + endings_of_maps_with_room() + "."}),
        wrong_usage("AnEndingNearOneForOthers", "a.farlod -o o.tff --at 1,2", {"o.tff", endings_of_a_place() + "."}),
        wrong_usage("NoEnding", "a.farlod -o o --at 1,2", {"\"o\"", endings_of_a_place()}),
        wrong_at("MisspeltOption", "--heigth 2", {"--heigth: there is no such option; did you mean --height?"}),
        wrong_at("UnknownOption", "--colour=red", {"--colour: there is no such option. "}),
        wrong_at("OneArgumentTooMany", "town", {"town: nothing is known of this argument"}),
        wrong_at("NoRays", "--rays 0", {"--rays", "1 to 10000000"}),
        wrong_at("NegativeRays", "--rays -3", {"--rays", "1 to 10000000"}),
        wrong_at("NegativeVerify", "--verify -4", {"--verify", "-4"}),
        wrong_usage("OneCoordinate", "a.farlod -o o.csv --at 1", {"--at: give X,Y or X,Y,Z"}),
        wrong_usage("CoordinateIsNoNumber", "a.farlod -o o.csv --at nan,2", {"--at", "nan,2"}),
        wrong_usage("ZeroStep", "a.farlod -o o.asc --grid 0", {"--grid: 0", "from 0.01 to 10000"}),
        wrong_usage("StepIsNoNumber", "a.farlod -o o.asc --grid nan", {"--grid: nan", "from 0.01 to 10000"}),
        wrong_grid("HeightIsNoNumber", "--height nan", {"--height: nan", "from 0 to 10000"}),
        wrong_grid("HeightInSpace", "--height 1e30", {"--height: 1e30", "from 0 to 10000"}),
        wrong_usage("SpacingIsNoNumber", "a.farlod -o o.csv --surfaces all --spacing nan", {"--spacing: nan"}),
        wrong_grid("BoxOfThreeNumbers", "--bbox 1,2,3", {"--bbox", "X0,Y0,X1,Y1"}),
        wrong_grid("BoxByAnUnknownWord", "--bbox town", {"--bbox", "city or grid"}),
        wrong_grid("BoxWithACommaTooMany", "--bbox 1,2,3,4,", {"--bbox", "X0,Y0,X1,Y1"}),
        wrong_usage("PlaceWithACommaTooMany", "a.farlod -o o.csv --at 1,2,", {"--at", "X,Y"}),
        wrong_grid("BoxInsideOut", "--bbox 3,2,1,4", {"--bbox", "X0 < X1"}),
        wrong_usage("BoxBeyondAllMachines", "a.farlod -o o.asc --grid 1 --bbox 0,0,1e300,1e300", {"--bbox", "nowhere on Earth"}),
        wrong_at("BoxWithoutGrid", "--bbox 0,0,1,1", {"--bbox", "--grid"}),
        wrong_at("PointsCrsWithoutPoints", "--points-crs EPSG:4326", {"--points-crs", "--points"}),
        wrong_at("PointsLayerWithoutPoints", "--points-layer a", {"--points-layer", "--points"}),
        wrong_at("PreviewWithoutGrid", "--preview p.png", {"--preview", "--grid"}),
        wrong_at("HistogramOfOneValue", "--histogram h.png", {"--histogram", "--grid, --points, --along and --surfaces"}),
        wrong_grid("HistogramIsNoPicture", "--histogram h.csv", {"--histogram", "h.csv", ".png, .svg, .pdf"}),
        wrong_grid("MapOfNoVerification", "--verify-map v.png", {"--verify-map", "give --verify"}),
        wrong_at("MapOfOneVerification", "--verify 1 --verify-map v.png",
                 {"--verify-map", "--grid, --points, --along and --surfaces"}),
        wrong_grid("MapOfAVerificationIsNoPicture", "--verify 1 --verify-map v.asc",
                   {"--verify-map", "v.asc", ".csv, .png, .svg, .pdf"}),
        wrong_at("ProjectionOfATable", "--projection equidistant", {"--projection", "picture of --at"}),
        wrong_usage("HorizonsOfASky", "a.farlod -o o.png --at 1,2 --horizons 36",
                    {"--horizons: a picture of the sky draws the horizon at every azimuth", "-o FILE.csv"}),
        wrong_usage("PatchesOfASky", "a.farlod -o o.png --at 1,2 --sky-patches 145", {"--sky-patches: a picture of the sky"}),
        wrong_usage("HoursOfASky", "a.farlod -o o.png --at 1,2 --quantity hidden",
                    {"--quantity: a picture of the sky shows svf"}),
        wrong_usage("HorizonsAndHoursOfAMap", "a.farlod -o o.png --grid 5 --horizons 36 --sun 2026-06-21",
                    {"--horizons: a file that ends in .png has room for one quantity only"}),
        wrong_grid("PreviewIsNoPicture", "--preview p.jpg", {"--preview", "p.jpg", ".png, .svg, .pdf"}),
        wrong_at("NoMemory", "--memory-limit 0", {"--memory-limit", "0"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    City, SvfRefuses,
    testing::Values(
        wrong_usage("WithoutSurfaces", "a.farlod -o o.city.json --grid 5 --city town.geojson", {"--city", "--surfaces"}),
        wrong_usage("OtherEnding", "a.farlod -o o.csv --surfaces all --city town.geojson", {"-o", "ends in .city.json"}),
        wrong_usage("NotNamed", "a.farlod -o o.city.json --surfaces all", {"-o", "--city"}),
        wrong_usage("Bounds", "a.farlod -o o.city.json --surfaces all --city town.geojson --bounds", {"--bounds", "--city"}),
        unusable("Missing", "a.farlod -o o.city.json --surfaces all --city lost.city.json", {"lost.city.json does not exist"}),
        unusable("AnotherFile", "a.farlod -o o.city.json --surfaces all --city word.csv",
                 {"word.csv is not a file that a.farlod was made of", "checksum"}),
        unusable("NoFolder", "a.farlod -o lost/o.city.json --surfaces all --city town.geojson",
                 {"lost/o.city.json", "no folder lost"}),
        unusable("NoPlaces", "a.farlod -o o.city.json --surfaces all --city town.geojson",
                 {"town.geojson has no places for attributes", "CityGML and CityJSON"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Matrix, SvfRefuses,
    testing::Values(
        wrong_grid("WithoutSurfaces", "--matrix m.npz", {"--matrix", "--surfaces"}),
        wrong_grid("EnergyPlusOfAGrid", "--energyplus m.idf", {"--energyplus", "--surfaces"}),
        wrong_usage("EnergyPlusOfNoModel", "a.farlod -o o.csv --surfaces all --energyplus m.csv",
                    {"--energyplus", "ends in .idf"}),
        wrong_usage("EnergyPlusOfSolidAngles", "a.farlod -o o.csv --surfaces all --energyplus m.idf --sky solid",
                    {"--energyplus", "--sky"}),
        wrong_usage("EnergyPlusByEightAzimuths",
                    "a.farlod -o o.csv --surfaces all --energyplus m.idf --quantity view_factors --wall-sectors 8",
                    {"--energyplus", "leave --wall-sectors out"}),
        wrong_usage("EnergyPlusOfACityFile", "a.farlod -o o.city.json --surfaces all --city town.geojson --energyplus m.idf",
                    {"--energyplus", "--city"}),
        wrong_usage("EnergyPlusOfAShard", "a.farlod -o o.csv --surfaces all --energyplus m.idf --shard 0/2",
                    {"--energyplus", "--merge"}),
        unusable("EnergyPlusNowhere", "a.farlod -o o.csv --surfaces all --energyplus lost/m.idf", {"no folder lost"}),
        wrong_usage("ThresholdOfNothing", "a.farlod -o o.csv --surfaces all --matrix-threshold 0.1", {"--matrix"}),
        wrong_usage("ThresholdAboveAll", "a.farlod -o o.csv --surfaces all --matrix m.npz --matrix-threshold 2",
                    {"--matrix-threshold", "from 0 to 1"}),
        wrong_usage("AnotherEnding", "a.farlod -o o.csv --surfaces all --matrix m.nc", {"--matrix", "ends in .npz"}),
        wrong_usage("OfACityFile", "a.farlod -o o.city.json --surfaces all --city town.geojson --matrix m.npz",
                    {"--matrix", "--city"}),
        wrong_usage("OfSolidAngles", "a.farlod -o o.csv --surfaces all --matrix m.npz --sky solid", {"--matrix", "--sky"}),
        wrong_usage("OfAnEstimate", "a.farlod -o o.csv --surfaces all --matrix m.npz --dry-run", {"--matrix", "--dry-run"}),
        wrong_usage("OfAShard", "a.farlod -o o.csv --surfaces all --matrix m.npz --shard 0/2", {"--matrix", "--merge"}),
        unusable("NoFolder", "a.farlod -o o.csv --surfaces all --matrix lost/m.npz", {"lost/m.npz", "no folder lost"})),
    name_of_refused);

/// Each format with the receivers that it is not for.
std::vector<RefusedCommand> formats_that_do_not_fit() {
  const std::string tables = endings_where([](const OutputFormat& f) { return f.holds_tables(); });
  const std::string pictures = endings_where([](const OutputFormat& f) { return f.is_picture; });
  const std::string rasters = endings_where([](const OutputFormat& f) { return f.raster_writer != nullptr; });
  std::vector<RefusedCommand> refused;
  for (const OutputFormat& format : output_formats()) {
    const std::string ending(format.endings[0]), name = ending.substr(1), command = "a.farlod -o o" + ending;
    if (format.raster_writer == nullptr)
      refused.push_back(wrong_usage("Grid_" + name, command + " --grid 5", {"-o", "--grid makes a raster", ending, rasters}));
    if (!format.holds_tables())
      for (const std::string receivers : {"--points word.csv", "--at 1,2", "--surfaces all"}) {
        // The sky above a place is a picture
        if (format.is_picture && receivers == "--at 1,2") continue;
        refused.push_back(wrong_usage(receivers.substr(2, receivers.find(' ') - 2) + "_" + name, command + " " + receivers,
                                      {"-o", "only --grid makes a raster", tables}));
      }
    if (!format.is_picture)
      refused.push_back(wrong_grid("Preview_" + name, "--preview p" + ending, {"--preview", "p" + ending, pictures}));
  }
  return refused;
}
INSTANTIATE_TEST_SUITE_P(Formats, SvfRefuses, testing::ValuesIn(formats_that_do_not_fit()), name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Points, SvfRefuses,
    testing::Values(unusable_points("Word", "word.csv", {"word.csv:3", "\"north\" is not a number"}),
                    unusable_points("ShortRow", "short.csv", {"short.csv:3", "ends before y"}),
                    unusable_points("NamelessColumns", "nameless.csv", {"nameless.csv:1", "x and y"}),
                    unusable_points("Empty", "empty.csv", {"empty.csv", "no points"}),
                    unusable_points("LayerOfATable", "word.csv --points-layer a", {"word.csv", "no layers"}),
                    unusable_points("HeaderAlone", "headed.csv", {"headed.csv", "no points"}),
                    unusable_points("BeyondAllMaps", "galaxy.csv", {"point 1", "nowhere on Earth"}),
                    unusable("AtBeyondAllMaps", "a.farlod -o o.csv --at 1e12,1e12", {"point 1", "nowhere on Earth"}),
                    unusable("AtInSpace", "a.farlod -o o.csv --at 500000,5500000,1e30", {"point 1", "nowhere on Earth"})),
    name_of_refused);

INSTANTIATE_TEST_SUITE_P(
    Output, SvfRefuses,
    testing::Values(
        unusable("NoFolder", "a.farlod -o lost/o.csv --at 500030,5500010", {"lost/o.csv", "no folder lost"}),
        unusable("NoFolderForPreview", "a.farlod -o o.asc --grid 5 --preview lost/p.png", {"lost/p.png", "no folder lost"}),
        unusable("NoFolderForSummary", "a.farlod -o o.asc --grid 5 --summary lost/s.json", {"lost/s.json", "no folder lost"}),
        unusable("FolderIsAFile", "a.farlod -o town.geojson/o.csv --at 500030,5500010", {"town.geojson/o.csv"})),
    name_of_refused);

#ifdef FARLOD_WITH_GDAL
INSTANTIATE_TEST_SUITE_P(Gdal, SvfRefuses,
                         testing::Values(unusable_points("BeyondThePole", "pole.csv --points-crs EPSG:4326",
                                                         {"point 1 at (9, 95)", "x is the longitude"}),
                                         unusable_points("PolygonsForPoints", "town.geojson",
                                                         {"town.geojson", "holds no points"}),
                                         unusable_points("UnknownPointsCrs", "pole.csv --points-crs EPSG:99999",
                                                         {"EPSG:99999", "not known", "EPSG:32632"})),
                         name_of_refused);
#endif

/// Without an answer nothing is written, neither the output nor what is kept of a run for another.
void expect_no_answer(const std::string& asked, const std::vector<std::string>& said) {
  const WorkFolder folder;
  add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
  expect_refusal(folder.run("farlod-svf a.farlod " + asked), exit_unusable_input, said);
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.asc")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.csv")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.asc.unfinished")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.csv.unfinished")));
}

TEST(SvfWithoutAnAnswer, OfABoxBesideTheCitySaysWhereTheCityIs) {
  expect_no_answer("-o o.asc --grid 5 --bbox 0,0,50,50", {"none of 100", "The city lies from", "check --bbox"});
}

TEST(SvfWithoutAnAnswer, OfRoofsBesideTheCityIsRefused) {
  expect_no_answer("-o o.csv --surfaces roofs --bbox 0,0,50,50", {"none of ", "The city lies from"});
}

TEST(SvfWithoutAnAnswer, OfAPointInABuildingIsRefused) {
  expect_no_answer("-o o.csv --at 500000,5500000",
                   {"500000, 5500000 has none (inside a building, whose top is 10.0 m above the ground)", "--on-surface"});
}

}  // namespace
}  // namespace farlod::acceptance
