// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "farlod/error.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/problems/problem_lists.hpp"
#include "tests/scenes/refusal.hpp"

// What the names that a user gives may lead to

namespace farlod::pipeline::test {
namespace {

using farlod::test::Fixture;
using farlod::test::fixtures_of_stages;
using farlod::test::good_city;
using farlod::test::is_of_trees;
using testing::ElementsAre;
using testing::HasSubstr;

/// An ESRI ASCII grid of 3 × 3 pixels of 1 km around the sample city.
constexpr const char* flat_raster = "ncols 3\nnrows 3\nxllcorner 548500\nyllcorner 5498500\ncellsize 1000\n7 7 7\n7 7 7\n7 7 7\n";

class PackInputs : public testing::Test {
 protected:
  std::vector<std::string> inputs_named() const {
    std::vector<std::string> names;
    for (const package::InputFile& input : packing.result.manifest.inputs) names.push_back(input.name);
    return names;
  }
  std::string refusal() {
    return scenes::refusal_of<InputError>([&] { packing.run(); });
  }

  Packing packing;
};

TEST_F(PackInputs, AFolderIsTheFilesInIt) {
  std::filesystem::create_directories(packing.folder.path() / "town");
  std::filesystem::copy(good_city(), packing.folder.path() / "town/b.city.json");
  packing.write("town/a.gml", "");
  packing.write("town/notes.pyc", "nothing");
  packing.settings.inputs = {packing.folder.path() / "town"};
  packing.run();
  EXPECT_THAT(inputs_named(), ElementsAre("a.gml", "b.city.json"));
  EXPECT_EQ(packing.codes(), std::set<int>{118});
  EXPECT_EQ(packing.result.skipped, (SkippedFeatures{{".pyc files", 1}}));
}

TEST_F(PackInputs, ARasterIsASurfaceModel) {
  packing.settings.georeference.crs = "EPSG:32632";
  packing.settings.inputs = {packing.write("dsm.asc", flat_raster)};
  packing.run();
  EXPECT_EQ(packing.result.manifest.buildings, 0U);
  EXPECT_EQ(packing.result.manifest.height_origin_m, 7.0);
  EXPECT_THAT(inputs_named(), ElementsAre("dsm.asc"));
}

TEST_F(PackInputs, ARasterBesideACityIsItsTerrain) {
  packing.settings.inputs = {packing.write("dem.asc", flat_raster), good_city()};
  packing.run();
  EXPECT_THAT(inputs_named(), ElementsAre("village.city.json", "dem.asc"));
  EXPECT_THAT(packing.stages_timed(), testing::Contains("terrain"));
}

TEST_F(PackInputs, TwoRastersAreOneTooMany) {
  packing.settings.georeference.crs = "EPSG:32632";
  packing.settings.inputs = {packing.write("a.asc", flat_raster), packing.write("b.asc", flat_raster)};
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("a.asc"), HasSubstr("b.asc"), HasSubstr("give one of them")));
  packing.settings.inputs = {packing.write("a.asc", flat_raster)};
  packing.settings.terrain = {packing.write("b.asc", flat_raster)};
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("a.asc"), HasSubstr("--terrain"), HasSubstr("give one of them")));
}

TEST_F(PackInputs, WhatWasTakenFromBesideAMeshIsSaid) {
  packing.settings.inputs = {
      packing.write("hut.obj", "v 0 0 0\nv 10 0 0\nv 0 8 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")};
  packing.write("hut.offset", "500000 5400000 100");
  packing.write("hut.prj", "EPSG:32632");
  packing.run();
  EXPECT_EQ(packing.result.manifest.epsg, 32632);
  EXPECT_THAT(packing.result.notes,
              ElementsAre(HasSubstr("hut.prj"), HasSubstr("500000.000, 5400000.000, 100.000 of hut.offset")));
}

/// --crs, which files that do not say their CRS need, and two of the problems are of. It overrules one file only.
georeference::GeoreferenceSettings georeference_of(const Fixture& fixture) {
  const bool is_overruled = fixture.name.first == static_cast<int>(ProblemCode::two_crs);
  return {"EPSG:32632", "", !is_overruled};
}

/// What has to be packed for the problem to show.
void use(const Fixture& fixture, StageSettings& settings) {
  settings.georeference = georeference_of(fixture);
  settings.inputs = inputs_with(fixture);
  if (!is_of_trees(fixture)) return;
  settings.inputs = {farlod::test::good_city()};
  const bool is_raster = fixture.path.extension() == ".asc";
  is_raster ? static_cast<void>(settings.trees.canopy = fixture.path) : settings.trees.files.push_back(fixture.path);
}

std::vector<Fixture> trees_of_ingest() {
  std::vector<Fixture> files = fixtures_of_stages(1, 1);
  std::erase_if(files, [](const Fixture& fixture) { return !is_of_trees(fixture); });
  return files;
}

class BrokenFile : public testing::TestWithParam<Fixture> {};

TEST_P(BrokenFile, HasExactlyItsProblemAndIsPacked) {
  const int code = GetParam().name.first;
  Packing p;
  use(GetParam(), p.settings);
  p.run();
  EXPECT_EQ(p.codes(), std::set<int>{code});
  const std::vector<std::pair<int, std::uint64_t>> counts{{code, p.report.problems().size()}};
  EXPECT_EQ(p.result.manifest.problem_counts, counts);
  EXPECT_EQ(PackageReader(p.settings.output).manifest().problem_counts, counts);
}

INSTANTIATE_TEST_SUITE_P(Pipeline, BrokenFile, testing::ValuesIn(fixtures_of_stages(2, 4)),
                         [](const auto& test) { return test.param.name.second; });
INSTANTIATE_TEST_SUITE_P(Trees, BrokenFile, testing::ValuesIn(trees_of_ingest()),
                         [](const auto& test) { return test.param.name.second; });

TEST_P(BrokenFile, IsRefusedWhereProblemsAre) {
  Packing p;
  use(GetParam(), p.settings);
  p.settings.problems = ProblemPolicy::refuse;
  EXPECT_THROW(p.run(), ProblemsRefused);
  EXPECT_EQ(p.codes(), std::set<int>{GetParam().name.first});
}

class PlacedProblem : public testing::TestWithParam<Fixture> {};

TEST_P(PlacedProblem, IsOnTheMapUnlessItIsOfNoPlace) {
  const std::set<ProblemCode> without_vertex{ProblemCode::no_geometry,       ProblemCode::no_dominant_direction,
                                             ProblemCode::nearly_empty_grid, ProblemCode::another_format,
                                             ProblemCode::empty_file,        ProblemCode::unusable_file};
  Packing p;
  use(GetParam(), p.settings);
  p.run();
  ASSERT_FALSE(p.report.problems().empty());
  for (const Problem& problem : p.report.problems()) {
    EXPECT_EQ(problem.position.has_value(), !without_vertex.contains(problem.code)) << problem.detail;
    const bool is_on_earth = problem.code != ProblemCode::outside_of_projection;
    EXPECT_EQ(problem.lon_lat_deg.has_value(), problem.position && is_on_earth) << problem.detail;
  }
}

INSTANTIATE_TEST_SUITE_P(Pipeline, PlacedProblem, testing::ValuesIn(fixtures_of_stages(1, 4)),
                         [](const auto& test) { return test.param.name.second; });

/// What is in the package when the problem had its effect.
struct Remains {
  std::set<std::string> buildings;
  std::uint64_t polygons;
};

std::set<std::string> house_names(int count) {
  std::set<std::string> names;
  for (int k = 0; k < count; ++k) names.insert("house " + std::to_string(k));
  return names;
}

TEST(BrokenFiles, LoseWhatIsLeftOutAndNothingElse) {
  const std::map<std::string, Remains> expected{
      {"outside_of_projection", {{"house", "neighbour"}, 12}},  // of three houses
      {"far_away", {{"house", "neighbour"}, 12}},
      {"axes_swapped", {{"house"}, 6}},
      {"two_crs", {{"house"}, 6}},
      {"crs_unknown", {{"house"}, 6}},
      {"unlikely_place", {{"house"}, 6}},
      {"zone_in_easting", {{"house"}, 6}},
      {"implausible_size", {{"house"}, 6}},
      {"lies_on_its_side", {house_names(12), 72}},
      {"undeclared_no_data", {{}, 0}},  // a surface model
      {"another_datum", {house_names(9), 54}},
      {"beyond_terrain", {house_names(9), 54}},
      {"described_twice", {{"house 0", "house 1", "house 2", "survey 0", "survey 1", "survey 2"}, 36}},
      {"no_dominant_direction", {{"rotunda"}, 66}},
      {"nearly_empty_grid", {{"house", "neighbour"}, 12}},
      {"zero_area", {{"house"}, 6}},  // of seven polygons
      {"self_intersecting", {{"house", "carport"}, 7}},
      {"not_planar", {{"house"}, 6}},
      {"spike", {{"house"}, 6}},
      {"hole_outside", {{"house"}, 6}},
      {"floor_in_the_air", {{"lower", "upper"}, 12}},
      {"below_ground", {{"house", "bunker"}, 12}},
  };
  for (const Fixture& fixture : fixtures_of_stages(2, 4)) {
    if (is_of_trees(fixture)) continue;
    const auto remains = expected.find(fixture.name.second);
    ASSERT_NE(remains, expected.end()) << "say what is left of " << fixture.path;
    Packing p;
    p.settings.inputs = {fixture.path};
    p.settings.georeference = georeference_of(fixture);
    p.run();
    EXPECT_EQ(ids_in(PackageReader(p.settings.output)), remains->second.buildings) << fixture.path;
    EXPECT_EQ(p.result.manifest.polygons, remains->second.polygons) << fixture.path;
  }
}

/// Two footprints of 7 m by 11 m in UTM 32N, which know the elevations of their roofs.
constexpr const char* footprints = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":"hall","roof":262.0},"geometry":{"type":"Polygon","coordinates":
 [[[8.4,49],[8.4001,49],[8.4001,49.0001],[8.4,49.0001],[8.4,49]]]}},
{"type":"Feature","properties":{"id":"cellar","roof":248.0},"geometry":{"type":"Polygon","coordinates":
 [[[8.401,49],[8.4011,49],[8.4011,49.0001],[8.401,49.0001],[8.401,49]]]}}]})";

/// An ESRI ASCII grid of 3 × 3 pixels of 1 km, 250 m high, around them.
constexpr const char* plain_name =
    "ncols 3\nnrows 3\nxllcorner 455000\nyllcorner 5426000\ncellsize 1000\n"
    "250 250 250\n250 250 250\n250 250 250\n";

struct RoofPacking : Packing {
  RoofPacking() {
    settings.inputs = {write("town.geojson", footprints)};
    settings.ingest.footprints.roof_field = "roof";
  }
  void run_on_plain() {
    settings.terrain = {write("dem.asc", plain_name)};
    settings.georeference.crs = "EPSG:32632";  // of the terrain
    run();
  }
};

TEST(RoofElevations, ReachDownToTheTerrain) {
  RoofPacking p;
  p.run_on_plain();
  EXPECT_EQ(p.result.manifest.height_origin_m, 250.0);
  const PackageReader package(p.settings.output);
  EXPECT_EQ(ids_in(package), std::set<std::string>{"hall"});
  float top_m = 0.0F;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
    for (const Point3f& v : package.tile(cells.cell_at(n)).mesh.vertices) top_m = std::max(top_m, v.z);
  EXPECT_EQ(top_m, 12.0F);
}

TEST(RoofElevations, BelowTheTerrainAreOnTheMap) {
  RoofPacking p;
  p.run_on_plain();
  ASSERT_EQ(p.report.count(ProblemCode::height_not_positive), 1U);
  const Problem& problem = p.report.problems()[0];
  EXPECT_EQ(problem.place, "cellar");
  // There and back between degrees and metres: PROJ promises a tenth of a millimetre, which is 1e-9 of a degree
  constexpr double projection_error_deg = 1e-9;
  EXPECT_NEAR(problem.lon_lat_deg.value().x, 8.401, projection_error_deg);
  EXPECT_NEAR(problem.lon_lat_deg.value().y, 49.0, projection_error_deg);
}

TEST(RoofElevations, NeedAGround) {
  RoofPacking p;
  const std::string refusal = scenes::refusal_of<InputError>([&] { p.run(); });
  EXPECT_NE(refusal.find("--terrain"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("--base-field"), std::string::npos) << refusal;
  EXPECT_FALSE(p.stages_told().contains("tiles"));
}

}  // namespace
}  // namespace farlod::pipeline::test
