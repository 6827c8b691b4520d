// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "farlod/error.hpp"
#include "package/crown.hpp"
#include "package/unfinished_package.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/problems/problem_lists.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::pipeline::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Crowns are floats of some hundred metres.
constexpr double float_error_m = 1e-4;

/// The crowns in a package, with their places in the output CRS and their heights.
struct PlacedCrown {
  Point2d place;
  double bottom_m, top_m;
  Crown crown;
};

std::vector<PlacedCrown> crowns_in(const fs::path& package, const package::Manifest& manifest) {
  const std::string bytes = scenes::text_of(package / package::crowns_file);
  package::CrownsHeader header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  EXPECT_EQ(header.file_bytes, bytes.size());
  std::vector<package::CrownCellRecord> cells(header.cell_count);
  std::vector<Crown> crowns(header.crown_count);
  std::memcpy(cells.data(), bytes.data() + sizeof header, cells.size() * sizeof cells[0]);
  std::memcpy(crowns.data(), bytes.data() + sizeof header + cells.size() * sizeof cells[0], crowns.size() * sizeof crowns[0]);
  std::vector<PlacedCrown> placed;
  for (const package::CrownCellRecord& cell : cells)
    for (std::uint64_t n = cell.first_crown; n < cell.first_crown + cell.crown_count; ++n) {
      const Crown& c = crowns[n];
      const Point2d p_grid = manifest.grid.corner_of({cell.i, cell.j}) + Point2d{c.x_m, c.y_m};
      const Point3d p = manifest.projected_from_grid({p_grid.x, p_grid.y, 0.0});
      placed.push_back({horizontal(p), c.bottom_m + manifest.height_origin_m, c.top_m + manifest.height_origin_m, c});
    }
  return placed;
}

/// The village, with trees.
struct TreePacking : Packing {
  TreePacking() {
    settings.grid.block_edge = 2;
    settings.grid.cell_edge_m = 25.0;
    settings.far_map = scenes::small_maps(FarMapKind::horizon);
    settings.inputs = {farlod::test::good_city()};
  }
  /// A table of trees in rows from a corner of the village, which is flat at 0 m.
  fs::path write_rows(const std::string& name, int count, double height_m = 9.0) const {
    std::ostringstream table;
    table << "x,y,height,crown,h_trunk\n";
    for (int n = 0; n < count; ++n)
      table << 549955 + 9 * (n % 10) << ".5," << 5499950 + 9 * (n / 10) << ".25," << height_m << ",4,3\n";
    return write(name, table.str());
  }
  /// A canopy of 2 m cells in the middle of the village.
  fs::path write_canopy(const std::string& name, const std::string& rows, const std::string& shape = "ncols 3\nnrows 2\n",
                        int cell_m = 2) const {
    return write(name, shape + "xllcorner 550000\nyllcorner 5500000\ncellsize " + std::to_string(cell_m) +
                           "\nNODATA_value -9999\n" + rows);
  }
  void run_as(const std::string& name) {
    settings.output = folder.path() / name;
    report = {};
    run();
  }
  [[nodiscard]] std::string bytes_of(const std::string& name) const { return scenes::text_of(folder.path() / name); }
  [[nodiscard]] std::vector<PlacedCrown> crowns() const { return crowns_in(settings.output, result.manifest); }
  [[nodiscard]] std::string refusal() {
    return scenes::refusal_of<Error>([&] { run(); });
  }
};

TEST(PackedTrees, StandWhereTheyAre) {
  TreePacking p;
  p.settings.trees.files = {p.write("trees.csv", "x,y,height,crown,h_trunk\n549990.5,5499990.25,9,4,3\n")};
  p.run();
  EXPECT_THAT(p.codes(), IsEmpty());
  const auto crowns = p.crowns();
  ASSERT_EQ(crowns.size(), 1U);
  EXPECT_NEAR(crowns[0].place.x, 549990.5, float_error_m);
  EXPECT_NEAR(crowns[0].place.y, 5499990.25, float_error_m);
  EXPECT_NEAR(crowns[0].bottom_m, 3.0, float_error_m);
  EXPECT_NEAR(crowns[0].top_m, 9.0, float_error_m);
  EXPECT_EQ(crowns[0].crown.half_width_m, 2.0F);
  EXPECT_EQ(p.result.crowns, (CrownCounts{1, 0}));
  ASSERT_TRUE(p.result.manifest.canopy.has_value());
  EXPECT_EQ(p.result.manifest.inputs.back().name, "trees.csv");
  EXPECT_GT(p.result.package_bytes, 0U);
}

TEST(PackedTrees, ComeFromSeveralFilesAndARaster) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 20), p.write_rows("b.csv", 30)};
  p.settings.trees.canopy = p.write_canopy("tops.asc", "8 9 0\n-9999 7 6\n");
  p.settings.trees.trunks = p.write_canopy("trunks.asc", "1 1 1\n1 1 -9999\n");
  p.run();
  EXPECT_EQ(p.result.crowns, (CrownCounts{30, 4}));
  EXPECT_EQ(p.codes(), std::set<int>{123});
  EXPECT_EQ(p.result.manifest.canopy->crowns(), 34U);
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("no height in the raster of trunks")));
  EXPECT_THAT(p.stages_timed(), testing::IsSupersetOf({"trees", "crowns"}));
}

TEST(PackedTrees, FilesThatCannotBeUsedAreLeftOutAmongOthers) {
  TreePacking p;
  p.settings.trees.files = {p.write("bad.csv", "a,b\n1,2\n"), p.write_rows("good.csv", 3), p.write("empty.csv", "")};
  p.run();
  EXPECT_EQ(p.codes(), (std::set<int>{118, 119}));
  EXPECT_EQ(p.result.crowns.of_trees, 3U);
  p.settings.trees.files = {p.folder.path() / "bad.csv", p.folder.path() / "empty.csv"};
  p.settings.overwrite = Overwrite::replace;
  EXPECT_THAT(p.refusal(), HasSubstr("None of the 2 inventories"));
  p.settings.trees.files = {p.folder.path() / "bad.csv"};
  EXPECT_THAT(p.refusal(), HasSubstr("no columns named lon and lat"));
  p.settings.trees.files = {p.folder.path() / "good.csv", p.folder.path() / "lost.csv"};
  EXPECT_THAT(p.refusal(), HasSubstr("lost.csv does not exist"));
}

TEST(PackedTrees, WrongFilesAreToldBeforeTheCityIsRead) {
  TreePacking p;
  const TreeSettings none = p.settings.trees;
  const auto expect = [&](const std::string& message) {
    p.told.clear();
    EXPECT_THAT(p.refusal(), HasSubstr(message));
    EXPECT_THAT(p.stages_told(), Not(Contains("ingest")));
    p.settings.trees = none;
  };
  p.settings.trees.files = {p.write("columns.csv", "a,b\n1,2\n")};
  expect("no columns named lon and lat");
  p.settings.trees.files = {p.write_rows("rows.csv", 3)};
  p.settings.trees.height_field = "HOEHE";
  expect("has no field \"HOEHE\"");
  p.settings.trees.files = {p.write("lines.geojson", R"({"type": "Feature", "properties": {}, "geometry": {"type": "LineString",
      "coordinates": [[9, 49], [9, 50]]}})")};
  expect("holds no layer of points or areas");
  p.settings.trees.canopy = p.folder.path() / "rows.csv";
  expect("is not a raster of the heights of crowns");
  p.settings.trees.canopy = p.write_canopy("tops.asc", "8 9 0\n-9999 7 6\n");
  p.settings.trees.trunks = p.folder.path() / "rows.csv";
  expect("is not a raster of the heights of crowns");
}

TEST(PackedTrees, AreCountedInTheEstimate) {
  TreePacking p;
  p.run_as("plain.farlod");
  const PackEstimate plain = p.result.estimate;
  p.settings.trees.files = {p.write_rows("a.csv", 50)};
  p.settings.trees.canopy = p.write_canopy("tops.asc", "8 9 0\n-9999 7 6\n");
  p.run_as("trees.farlod");
  const PackEstimate& e = p.result.estimate;
  constexpr double mib = 1048576.0, rounding = 1e-9;
  EXPECT_NEAR(e.package_mib - plain.package_mib, 54 * sizeof(Crown) / mib, rounding);
  // Trees and crowns are 32 bytes each, and the pixels of the raster that lie over the city four
  EXPECT_NEAR(e.memory_mib - plain.memory_mib, (50 * 32 + 54 * 32 + 6 * 4) / mib, rounding);
}

TEST(PackedTrees, PackagesWithoutAnyHaveNoFile) {
  TreePacking p;
  p.run_as("plain.farlod");
  EXPECT_FALSE(p.result.manifest.canopy);
  EXPECT_FALSE(fs::exists(p.settings.output / package::crowns_file));
}

TEST(PackedTrees, OfAnotherPlaceAloneAreRefused) {
  TreePacking p;
  const std::filesystem::path far = p.write("far.csv", "x,y,height,crown\n590000,5490000,8,4\n590010,5490000,8,4\n");
  p.settings.trees.files = {far};
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { p.run_as("far.farlod"); }),
              testing::AllOf(HasSubstr("far.csv: does not meet the city"), HasSubstr("no tree of 2 stands")));
  // Beside others they are told
  p.settings.trees.files = {far, p.write("near.csv", "x,y,height,crown\n549990.5,5499990.25,8,4\n")};
  p.run_as("both.farlod");
  EXPECT_EQ(p.codes(), std::set<int>{210});
  EXPECT_EQ(p.result.crowns, (CrownCounts{1, 0}));
}

TEST(PackedTrees, StandOnTheTerrain) {
  TreePacking p;
  std::string rows;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) rows += std::to_string(0.1 * column) + " ";
    rows += "\n";
  }
  p.settings.terrain = {p.write("dem.asc", "ncols 20\nnrows 20\nxllcorner 549900\nyllcorner 5499900\ncellsize 10\n" + rows)};
  p.settings.trees.files = {p.write("trees.csv", "x,y,height,crown,h_trunk\n549990,5499990,9,4,3\n")};
  p.settings.trees.canopy = p.write_canopy("tops.asc", "20 0 0\n0 0 0\n");
  p.settings.trees.heights = CanopyHeights::elevations;
  p.run();
  // Its nodes are the centres of its pixels: 0 m at 549905 m, and a hundredth more from metre to metre
  auto crowns = p.crowns();
  ASSERT_EQ(crowns.size(), 2U);
  if (crowns[0].crown.shape == CrownShape::prism) std::swap(crowns[0], crowns[1]);
  EXPECT_NEAR(crowns[0].bottom_m, 0.85 + 3.0, float_error_m);
  EXPECT_NEAR(crowns[0].top_m, 0.85 + 9.0, float_error_m);
  const double ground_m = 0.01 * (550001.0 - 549905.0);
  EXPECT_NEAR(crowns[1].place.x, 550001.0, float_error_m);
  EXPECT_NEAR(crowns[1].place.y, 5500003.0, float_error_m);
  EXPECT_NEAR(crowns[1].top_m, 20.0, float_error_m);
  EXPECT_NEAR(crowns[1].bottom_m, ground_m + 0.25 * (20.0 - ground_m), float_error_m);
}

TEST(PackedTrees, ShardsMakeThePackageOfOneRun) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 40)};
  p.settings.trees.canopy = p.write_canopy("tops.asc", "8 9 0\n-9999 7 6\n");
  p.run_as("whole.farlod");
  const CrownCounts counts = p.result.crowns;
  p.settings.part = PackPart::shard;
  for (const std::size_t index : {1U, 0U}) {
    p.settings.shard = {index, 2};
    p.run_as("shards.farlod");
    EXPECT_EQ(p.result.crowns, counts) << "what another shard has read is told, too";
  }
  p.settings.part = PackPart::merge;
  const TreeSettings same = p.settings.trees;
  p.settings.trees.trunk_ratio = 0.5;
  EXPECT_THAT(p.refusal(), HasSubstr("--trunk-ratio was 0.25, and is 0.5"));
  p.settings.trees = same;
  p.run_as("shards.farlod");
  EXPECT_EQ(p.bytes_of("shards.farlod"), p.bytes_of("whole.farlod"));
  EXPECT_EQ(p.result.crowns, counts);
}

TEST(PackedTrees, AreasMakeThePackageOfOneRun) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 40)};
  p.run_as("whole.farlod");
  p.settings.area = Box2d{{549950.0, 5499950.0}, {549990.0, 5499990.0}};
  p.run_as("parts.farlod");
  EXPECT_EQ(p.bytes_of("parts.farlod/crowns.bin"), p.bytes_of("whole.farlod/crowns.bin"));
  p.settings.area.reset();
  p.settings.resume = true;
  p.run_as("parts.farlod");
  EXPECT_EQ(p.bytes_of("parts.farlod"), p.bytes_of("whole.farlod"));
  // Other trees are another package
  p.settings.area = Box2d{{549950.0, 5499950.0}, {549990.0, 5499990.0}};
  p.settings.resume = false;
  p.write_rows("a.csv", 39);
  EXPECT_THAT(p.refusal(), HasSubstr("the input a.csv has changed"));
}

TEST(PackedTrees, PackagesWithThemAreReplaced) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 5)};
  p.run();
  p.settings.overwrite = Overwrite::replace;
  p.settings.trees.files.clear();
  p.run();
  EXPECT_FALSE(fs::exists(p.settings.output / package::crowns_file));
}

TEST(PackedTrees, OtherRulesAreAnotherPackage) {
  TreePacking p;
  p.settings.trees.files = {p.write("a.csv", "x,y,height,crown\n549990.5,5499990.25,9,4\n")};
  p.run();
  p.settings.trees.trunk_ratio = 0.5;
  p.settings.area = Box2d{{549950.0, 5499950.0}, {549990.0, 5499990.0}};
  EXPECT_THAT(p.refusal(), HasSubstr("is not the package of these inputs and options"));
}

TEST(PackedTrees, DamagedCrownsAreMadeAnew) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 40)};
  p.run_as("whole.farlod");
  p.run_as("mended.farlod");
  p.settings.resume = true;
  for (const bool is_lost : {true, false}) {
    const fs::path file = p.settings.output / package::crowns_file;
    if (is_lost)
      fs::remove(file);
    else
      std::fstream(file, std::ios::binary | std::ios::in | std::ios::out).seekp(100).put('!');
    p.run_as("mended.farlod");
    EXPECT_EQ(p.bytes_of("mended.farlod"), p.bytes_of("whole.farlod"));
  }
}

TEST(PackedTrees, InterruptedRunsGoOnWithTheSameBytes) {
  TreePacking p;
  p.settings.trees.files = {p.write_rows("a.csv", 40)};
  p.run_as("whole.farlod");
  p.settings.output = p.folder.path() / "resumed.farlod";
  std::stop_source source;
  RunSettings stopped;
  stopped.stop = source.get_token();
  stopped.on_progress = [&](const Progress& progress) {
    if (progress.stage == "far maps" && progress.done == 2) source.request_stop();
  };
  EXPECT_THROW((void)pack(p.settings, p.report, stopped), Cancelled);
  p.settings.resume = true;
  p.run_as("resumed.farlod");
  EXPECT_GE(p.result.blocks_found, 2U);
  EXPECT_EQ(p.bytes_of("resumed.farlod"), p.bytes_of("whole.farlod"));
}

}  // namespace
}  // namespace farlod::pipeline::test
