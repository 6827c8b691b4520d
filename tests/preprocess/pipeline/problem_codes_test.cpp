// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/problems/problem_lists.hpp"

namespace farlod::pipeline::test {
namespace {

using farlod::test::Fixture;
using farlod::test::fixtures_of_stages;
using farlod::test::is_of_trees;

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
      {"no_dominant_direction", {{"rotunda"}, 66}},
      {"nearly_empty_grid", {{"house", "neighbour"}, 12}},
      {"zero_area", {{"house"}, 6}},  // of seven polygons
      {"self_intersecting", {{"house", "carport"}, 7}},
      {"not_planar", {{"house"}, 6}},
      {"spike", {{"house"}, 6}},
      {"hole_outside", {{"house"}, 6}},
      {"floor_in_the_air", {{"lower", "upper"}, 12}},
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

}  // namespace
}  // namespace farlod::pipeline::test
