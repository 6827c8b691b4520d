// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pack.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <span>

#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/scenes/footprints_text.hpp"

namespace farlod::pipeline::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsSupersetOf;

/// A footprint of 7 m by 11 m.
struct House {
  const char* id;
  int column, row;
  double height_m;
};
std::string houses(const std::vector<House>& list) {
  scenes::FootprintsText text("");
  for (const auto& [id, column, row, height_m] : list) {
    const Point2d p{8.4 + 0.001 * column, 49.0 + 0.001 * row};
    text.add(scenes::building(id, height_m), Box2d{p, p + Point2d{0.0001, 0.0001}});
  }
  return text.text();
}

/// Three houses at the corners of a triangle of 140 m, and a footprint of height zero between them.
std::string three_houses_and_a_pit() {
  return houses({{"west", 0, 0, 9.0}, {"pit", 1, 0, 0.0}, {"east", 2, 0, 30.0}, {"north", 1, 1, 12.0}});
}

/// Cells of 50 m in blocks of 2 × 2, so that the triangle lies in several of each.
struct TownPacking : Packing {
  TownPacking() {
    settings.grid.block_edge = 2;
    settings.grid.cell_edge_m = 50.0;
    settings.inputs = {write("town.geojson", three_houses_and_a_pit())};
  }
};

TEST(Pack, CountsWhatIsInThePackage) {
  TownPacking p;
  p.run();
  const package::Manifest& m = p.result.manifest;
  EXPECT_EQ(m.buildings, 3U);
  EXPECT_EQ(m.polygons, 3U * 6U);
  ASSERT_GT(m.grid.cells.size(), 4);

  const PackageReader package(p.settings.output);
  std::uint64_t triangles = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.grid.cells.size()); ++n)
    triangles += package.tile(m.grid.cells.cell_at(n)).mesh.triangles.size();
  EXPECT_EQ(m.triangles, triangles);
  EXPECT_EQ(package.manifest().triangles, triangles);
  EXPECT_EQ(package.manifest().polygons, m.polygons);
  EXPECT_EQ(package.manifest().buildings, m.buildings);
}

TEST(Pack, EndsBeforeTheTilesWhereTheMemoryIsShort) {
  TownPacking p;
  p.run_settings.memory_limit_mib = 1;
  EXPECT_THROW(p.run(), LimitReached);
  EXPECT_FALSE(p.stages_told().contains("tiles"));
  EXPECT_FALSE(fs::exists(p.settings.output));
}

TEST(Pack, RefusesProblemsOnceTheReportIsCompleteAndBeforeFarMaps) {
  TownPacking p;
  p.settings.problems = ProblemPolicy::refuse;
  EXPECT_THROW(p.run(), ProblemsRefused);
  EXPECT_TRUE(p.stages_told().contains("tiles"));
  EXPECT_FALSE(p.stages_told().contains("far maps"));
  EXPECT_EQ(p.codes(), std::set<int>{109});
  EXPECT_FALSE(fs::exists(p.settings.output));
}

TEST(Pack, TellsItsEstimateOnceBeforeTheTiles) {
  TownPacking p;
  std::vector<PackEstimate> told;
  bool cutting = false;
  p.run_settings.on_progress = [&](const Progress& progress) { cutting |= progress.stage == "tiles"; };
  const PackedCity result = pack(p.settings, p.report, p.run_settings, [&](const PackEstimate& estimate) {
    told.push_back(estimate);
    EXPECT_FALSE(cutting);
  });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().cells, static_cast<std::uint64_t>(result.manifest.grid.cells.size()));
  EXPECT_EQ(told.front().memory_mib, result.estimate.memory_mib);
}

/// Of the sections of a tiles file that far maps of the kind `horizon` need.
std::uint64_t far_bytes_in_tiles(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  package::Header header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  std::uint64_t bytes = 0;
  for (std::uint32_t n = 0; n < header.section_count; ++n) {
    package::Section section{};
    file.read(reinterpret_cast<char*>(&section), sizeof section);
    if (section.kind >= package::SectionKind::far_cells && section.kind <= package::SectionKind::explicit_edges)
      bytes += section.count * section.element_bytes;
  }
  return bytes;
}

class PackKind : public testing::TestWithParam<FarMapKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, PackKind, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

TEST_P(PackKind, WritesEveryBlockOfTheGridAndSaysHowManyBytes) {
  TownPacking p;
  p.settings.far_map.kind = GetParam();
  p.run();
  const package::Manifest& m = p.result.manifest;
  std::vector<Block> written;
  for (const package::BlockFiles& b : m.blocks) written.push_back(b.block);
  EXPECT_EQ(written, m.grid.blocks());
  EXPECT_GT(written.size(), 1U);
  std::uint64_t bytes = 0, far_map_bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(p.settings.output)) {
    if (!entry.is_regular_file()) continue;
    bytes += entry.file_size();
    if (entry.path().filename() == package::far_map_file) far_map_bytes += entry.file_size();
    if (entry.path().filename() == package::tiles_file) far_map_bytes += far_bytes_in_tiles(entry.path());
  }
  EXPECT_EQ(p.result.package_bytes, bytes);
  EXPECT_EQ(p.result.far_map_bytes, far_map_bytes);
  EXPECT_EQ(PackageReader(p.settings.output).manifest().far_map.is_box(), GetParam() == FarMapKind::box);
}

TEST(Pack, WhatIsLeftOutIsInTheReportAndNotInThePackage) {
  TownPacking p;
  p.run();
  ASSERT_EQ(p.report.problems().size(), 1U);
  EXPECT_EQ(p.report.problems()[0].code, ProblemCode::height_not_positive);
  EXPECT_EQ(p.report.problems()[0].place, "pit");
  EXPECT_THAT(p.result.manifest.problem_counts, ElementsAre(std::pair(109, std::uint64_t{1})));
  EXPECT_EQ(ids_in(PackageReader(p.settings.output)), (std::set<std::string>{"east", "north", "west"}));
}

TEST(Pack, TimesEveryStageInItsOrder) {
  TownPacking p;
  p.run();
  EXPECT_THAT(p.stages_timed(),
              ElementsAre("inputs", "ingest", "georeference", "align", "tiles", "city_index", "far_maps", "package", "publish"));
  for (const auto& [stage, seconds] : p.result.stage_seconds) EXPECT_GE(seconds, 0.0) << stage;
}

TEST(Pack, TellsHowFarItIs) {
  TownPacking p;
  p.run();
  EXPECT_THAT(p.stages_told(), IsSupersetOf({"ingest", "georeference", "align", "tiles", "far maps"}));
  std::size_t expected_done = 0;
  for (const Told& t : p.told) {
    EXPECT_LE(t.done, t.all) << t.stage;
    if (t.stage != "far maps") continue;
    EXPECT_EQ(t.done, expected_done++) << "blocks are told one by one";
    EXPECT_EQ(t.all, p.result.manifest.grid.blocks().size());
  }
  EXPECT_GE(expected_done, p.result.manifest.grid.blocks().size());
}

TEST(Pack, StampsItsInputs) {
  TownPacking p;
  const std::string town = three_houses_and_a_pit(), more = houses({{"south", 1, -1, 7.0}});
  p.settings.inputs.push_back(p.write("more.geojson", more));
  p.run();
  const auto& inputs = p.result.manifest.inputs;
  ASSERT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs[0].name, "town.geojson");
  EXPECT_EQ(inputs[1].name, "more.geojson");
  EXPECT_EQ(inputs[0].stamp, stamp_of(std::as_bytes(std::span(town))));
  EXPECT_EQ(inputs[1].stamp, stamp_of(std::as_bytes(std::span(more))));
  EXPECT_EQ(inputs[1].stamp.bytes, more.size());
}

TEST(Pack, StampsAreXxh3AsItsOwnToolPrintsIt) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.path() / "empty");
  std::ofstream(folder.path() / "name", std::ios::binary) << "Far-LoD\n";
  EXPECT_EQ(stamp_of(folder.path() / "empty"), (package::FileStamp{0, 0x2d06800538d394c2}));
  EXPECT_EQ(stamp_of(folder.path() / "name"), (package::FileStamp{8, 0xcf7fa6b8eed17038}));
}

TEST(Pack, RefusesAFolderThatExistsBeforeTheLongWork) {
  TownPacking p;
  p.run();
  p.told.clear();
  EXPECT_THROW(p.run(), OutputError);
  for (const char* stage : {"terrain", "align", "tiles", "city_index", "far maps"})
    EXPECT_FALSE(p.stages_told().contains(stage)) << stage << " was begun in vain";
  EXPECT_EQ(ids_in(PackageReader(p.settings.output)).size(), 3U) << "the old package must stay as it was";
}

TEST(Pack, ReplacesAPackageWhenAsked) {
  TownPacking p;
  p.run();
  p.settings.inputs = {p.write("hut.geojson", houses({{"hut", 0, 0, 3.0}}))};
  p.settings.overwrite = Overwrite::replace;
  p.run();
  EXPECT_EQ(ids_in(PackageReader(p.settings.output)), (std::set<std::string>{"hut"}));
}

TEST(Pack, AnInputThatCannotBeReadCostsNobodyTheOldPackage) {
  TownPacking p;
  p.run();
  p.settings.inputs = {p.write("broken.geojson", "{")};
  p.settings.overwrite = Overwrite::replace;
  EXPECT_THROW(p.run(), InputError);
  EXPECT_EQ(ids_in(PackageReader(p.settings.output)).size(), 3U);
}

/// An ESRI ASCII grid of 3 × 3 pixels of 1 km, 250 m high, around the town in UTM 32N.
constexpr const char* plain_around_the_town =
    "ncols 3\nnrows 3\nxllcorner 455000\nyllcorner 5426000\ncellsize 1000\n"
    "250 250 250\n250 250 250\n250 250 250\n";

TEST(Pack, HousesThatKnowOnlyTheirHeightStandOnTheTerrain) {
  TownPacking p;
  p.settings.georeference.crs = "EPSG:32632";
  p.settings.terrain = {p.write("dem.asc", plain_around_the_town)};
  p.run();
  EXPECT_EQ(p.result.manifest.height_origin_m, 250.0);
  EXPECT_EQ(p.result.manifest.buildings, 3U);
  EXPECT_THAT(p.stages_timed(), ElementsAre("inputs", "ingest", "georeference", "align", "terrain", "far_terrain", "tiles",
                                            "city_index", "far_maps", "package", "publish"));
  ASSERT_EQ(p.result.manifest.inputs.size(), 2U);
  EXPECT_EQ(p.result.manifest.inputs[1].name, "dem.asc");
  EXPECT_EQ(p.result.manifest.inputs[1].stamp.bytes, std::string_view(plain_around_the_town).size());
}

TEST(Pack, ATerrainAloneIsACityWithoutBuildings) {
  TownPacking p;
  p.settings.inputs.clear();
  p.settings.georeference.crs = "EPSG:32632";
  p.settings.terrain = {p.write("dem.asc", plain_around_the_town)};
  p.run();
  EXPECT_EQ(p.result.manifest.buildings, 0U);
  EXPECT_GT(p.result.manifest.triangles, 0U);
  EXPECT_THAT(p.stages_timed(),
              ElementsAre("inputs", "georeference", "terrain", "align", "tiles", "city_index", "far_maps", "package", "publish"));
}

}  // namespace
}  // namespace farlod::pipeline::test
