// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <sstream>

#include "farlod/error.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::pipeline::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// All files of a folder by their paths within it.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = scenes::text_of(entry.path());
  return files;
}

/// The names of the files that only one of two folders has, or that are others there.
std::string difference(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  std::string names;
  for (const auto& [name, text] : a)
    if (!b.contains(name) || b.at(name) != text) names += name + " ";
  for (const auto& [name, text] : b)
    if (!a.contains(name)) names += name + " ";
  return names;
}

constexpr double west_m = 500000.0, south_m = 5500000.0;

/// Nine by nine houses of 10 m in 370 m by 370 m, higher to the north-east.
std::string town(double highest_m = 40.0) {
  scenes::FootprintsText houses;
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 9; ++row) {
      const Point2d p{west_m + 45.0 * column, south_m + 45.0 * row};
      const double height_m = 5.0 + (highest_m - 5.0) * (column + row) / 16.0;
      houses.add(scenes::building(std::to_string(10 * column + row), height_m), Box2d{p, p + Point2d{10.0, 10.0}});
    }
  return houses.text();
}

/// Cells of 25 m in blocks of 4 × 4.
struct AreaPacking : Packing {
  explicit AreaPacking(FarMapKind kind = FarMapKind::horizon) {
    settings.grid.block_edge = 4;
    settings.grid.cell_edge_m = 25.0;
    settings.far_map = scenes::small_maps(kind);
    settings.inputs = {write("town.geojson", town())};
  }
  /// Packs with an area in metres from the south-west of the town, into a folder of this name.
  void run_area(const FarMapArea& area, const std::string& name = "city.farlod") {
    settings.output = folder.path() / name;
    settings.area = area;
    run();
  }
  void run_whole(const std::string& name) {
    settings.output = folder.path() / name;
    settings.area.reset();
    run();
  }
  [[nodiscard]] std::map<std::string, std::string> files(const std::string& name = "city.farlod") const {
    return files_in(folder.path() / name);
  }
  /// What a run that must not add anything says.
  std::string refusal(const FarMapArea& area) {
    const auto before = files();
    try {
      run_area(area);
    } catch (const OutputError& error) {
      EXPECT_EQ(difference(files(), before), "");
      return error.what();
    }
    return "no refusal";
  }
};

FarMapArea box(double x0, double y0, double x1, double y1) {
  return Box2d{{west_m + x0, south_m + y0}, {west_m + x1, south_m + y1}};
}

/// Some cells of a block; cells of four blocks; a block and more; all cells.
const FarMapArea corner = box(30, 30, 60, 60), middle = box(180, 150, 240, 260), quarter = box(-10, -10, 190, 190),
                 all = box(-100, -100, 600, 600);

class AreaKind : public testing::TestWithParam<FarMapKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, AreaKind, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

TEST_P(AreaKind, HasTheFarMapsOfItsCellsAndTheTilesOfAll) {
  AreaPacking p(GetParam());
  p.run_whole("whole.farlod");
  p.run_area(middle);
  const PackageReader part(p.folder.path() / "city.farlod"), whole(p.folder.path() / "whole.farlod");
  const CellRange& cells = whole.grid().cells;
  std::size_t mapped = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    const Cell cell = cells.cell_at(n);
    const MeshView a = part.tile(cell).mesh, b = whole.tile(cell).mesh;
    EXPECT_TRUE(std::ranges::equal(a.vertices, b.vertices)) << cell.i << ' ' << cell.j;
    EXPECT_EQ(a.triangles.size(), b.triangles.size());
    EXPECT_TRUE(whole.has_far_map(cell));
    mapped += part.has_far_map(cell) ? 1 : 0;
  }
  EXPECT_GT(mapped, 8U);
  EXPECT_LT(mapped, 40U);
  EXPECT_EQ(part.manifest().cells_with_far_map(), mapped);
  EXPECT_EQ(p.result.package.cells_with_far_map, mapped);
}

/// Explicit occluders by their places, not by their rows.
std::vector<std::tuple<Point3f, Point3f, std::uint16_t, std::uint16_t>> occluders_of(const FarHorizon& map) {
  std::vector<std::tuple<Point3f, Point3f, std::uint16_t, std::uint16_t>> result;
  for (const package::ExplicitOccluder& o : map.occluders.explicit_edges) {
    const HorizonEdge& e = map.occluders.edges[o.row];
    result.emplace_back(e.a, e.b, o.squares, o.layers);
  }
  return result;
}

TEST(Area, FarMapsAreThoseOfTheWholePackage) {
  AreaPacking p;
  p.run_whole("whole.farlod");
  p.run_area(middle);
  const PackageReader part(p.folder.path() / "city.farlod"), whole(p.folder.path() / "whole.farlod");
  const CellRange& cells = whole.grid().cells;
  std::size_t explicit_occluders = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    if (!part.has_far_map(cells.cell_at(n))) continue;
    const FarHorizon a = part.far_horizon(cells.cell_at(n)), b = whole.far_horizon(cells.cell_at(n));
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.estimate, b.estimate);
    EXPECT_EQ(a.high, b.high);
    EXPECT_EQ(a.overhang, b.overhang);
    EXPECT_EQ(a.patches.levels_m(), b.patches.levels_m());
    EXPECT_EQ(a.occluders.cell_from_block_m, b.occluders.cell_from_block_m);
    EXPECT_TRUE(occluders_of(a) == occluders_of(b));
    explicit_occluders += a.occluders.explicit_edges.size();
  }
  EXPECT_GT(explicit_occluders, 0U);
}

TEST_P(AreaKind, TheOrderOfRunsChangesNoByte) {
  AreaPacking p(GetParam());
  for (const FarMapArea& area : {corner, middle, quarter}) p.run_area(area, "one_by_one.farlod");
  for (const FarMapArea& area : {quarter, corner, middle}) p.run_area(area, "another.farlod");
  p.run_area(quarter, "at_once.farlod");
  EXPECT_NE(difference(p.files("at_once.farlod"), p.files("one_by_one.farlod")), "");
  const auto both = p.write("both.csv", [] {
    // A point in each cell of 25 m that either area may meet
    std::ostringstream points;
    points << "x,y\n" << std::fixed;
    for (const auto& [x0, y0, x1, y1] : {std::tuple(180, 150, 240, 260), {-10, -10, 190, 190}})
      for (int x = x0; x <= x1; ++x)
        for (int y = y0; y <= y1; ++y) points << west_m + x << ',' << south_m + y << '\n';
    return points.str();
  }());
  p.run_area(both, "together.farlod");
  EXPECT_EQ(difference(p.files("one_by_one.farlod"), p.files("another.farlod")), "");
  EXPECT_EQ(difference(p.files("one_by_one.farlod"), p.files("together.farlod")), "");
}

TEST_P(AreaKind, APackageWithAllFarMapsIsThatOfARunWithoutAnArea) {
  AreaPacking p(GetParam());
  p.run_whole("whole.farlod");
  p.run_area(corner);
  p.run_area(all);
  EXPECT_EQ(difference(p.files(), p.files("whole.farlod")), "");
  // Nothing is missing there
  p.run_area(middle);
  EXPECT_EQ(difference(p.files(), p.files("whole.farlod")), "");
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("have far maps already")));
  EXPECT_THAT(p.stages_timed(), Not(Contains("city_index")));
}

TEST(Area, LeavesAloneWhatNeedsNoNewFarMaps) {
  AreaPacking p;
  p.run_area(corner);
  const auto before = p.files();
  std::map<std::string, fs::file_time_type> written;
  for (const auto& [name, text] : before) written[name] = fs::last_write_time(p.settings.output / name);
  p.run_area(box(300, 300, 310, 310));
  std::size_t kept = 0;
  for (const auto& [name, text] : p.files()) {
    if (name == package::manifest_file || !before.contains(name)) continue;
    EXPECT_EQ(fs::last_write_time(p.settings.output / name), written.at(name)) << name;
    ++kept;
  }
  EXPECT_GT(kept, 10U);
}

/// What is no part of a package would go with the one that is replaced.
TEST(Area, SweepsOldBlocksAndNothingElse) {
  AreaPacking p;
  p.run_area(corner);
  const fs::path blocks = p.settings.output / "blocks";
  for (const char* name : {"7_7_3", "-1_5"}) fs::create_directories(blocks / name);
  for (const char* foreign : {"notes", "0_0_old", "7_7_3/thesis.txt"}) {
    fs::create_directories(blocks / foreign);
    EXPECT_THAT(p.refusal(middle), HasSubstr("holds blocks/" + std::string(foreign)));
    fs::remove(blocks / foreign);
  }
  p.run_area(middle);
  EXPECT_FALSE(fs::exists(blocks / "7_7_3"));
  EXPECT_FALSE(fs::exists(blocks / "-1_5"));
}

TEST(Area, SaysHowManyBytesThePackageHas) {
  AreaPacking p;
  for (const FarMapArea& area : {corner, middle}) {
    p.run_area(area);
    std::uint64_t bytes = 0;
    for (const auto& [name, text] : p.files()) bytes += text.size();
    EXPECT_EQ(p.result.package_bytes, bytes);
  }
}

TEST(Area, EstimatesOnlyTheFarMapsThatItBakes) {
  AreaPacking p;
  p.run_area(corner);
  const PackEstimate part = p.result.estimate;
  EXPECT_EQ(part.far_maps, p.result.package.cells_with_far_map);
  p.run_whole("whole.farlod");
  EXPECT_EQ(p.result.estimate.far_maps, p.result.estimate.cells);
  EXPECT_LT(part.package_mib, p.result.estimate.package_mib);
  EXPECT_LT(part.seconds, p.result.estimate.seconds);
}

TEST(Area, TellsHowFarItIs) {
  AreaPacking p;
  p.run_area(middle);
  std::size_t expected_done = 0;
  for (const Told& t : p.told)
    if (t.stage == "far maps") {
      EXPECT_EQ(t.done, expected_done++) << "blocks are told one by one";
      EXPECT_EQ(t.all, p.result.manifest.blocks.size());
    }
  EXPECT_EQ(expected_done, p.result.manifest.blocks.size() + 1);
}

TEST(Area, RefusesAnotherCity) {
  AreaPacking p;
  p.run_area(corner);
  p.write("town.geojson", town(60.0));
  EXPECT_THAT(p.refusal(middle), AllOf(HasSubstr("the input town.geojson has changed"), HasSubstr("--force")));
  p.write("town.geojson", town());
  p.settings.inputs.push_back(p.write("more.geojson", town()));
  EXPECT_THAT(p.refusal(middle), HasSubstr("made of 1 input files, and there are 2 now"));
  p.settings.inputs.pop_back();
  EXPECT_EQ(p.refusal(middle), "no refusal");
}

TEST(Area, RefusesOtherSettings) {
  AreaPacking p;
  p.run_area(corner);
  const StageSettings same = p.settings;
  p.settings.grid.cell_edge_m = 50.0;
  EXPECT_THAT(p.refusal(middle), HasSubstr("\"grid.cell_m\" was 25.0, and is 50.0"));
  p.settings = same;
  p.settings.far_map.horizon.tolerance = 0.01;
  EXPECT_THAT(p.refusal(middle), HasSubstr("settings.far_map.tolerance"));
  p.settings = same;
  p.settings.assign = Assign::whole;
  EXPECT_THAT(p.refusal(middle), HasSubstr("settings.assign"));
}

/// The manifest does not name all settings of the input: the tiles themselves are compared.
TEST(Area, RefusesOtherTiles) {
  AreaPacking p;
  std::string text = town();
  for (std::size_t at = text.find("height"); at != std::string::npos; at = text.find("height", at)) text.replace(at, 6, "colour");
  p.write("town.geojson", text);
  p.settings.ingest.footprints.default_height_m = 12.0;
  p.run_area(corner);
  p.settings.ingest.footprints.default_height_m = 13.0;
  EXPECT_THAT(p.refusal(middle), HasSubstr("are not those of this run"));
  EXPECT_THAT(p.refusal(corner), HasSubstr("are not those of this run"));
}

TEST(Area, ReplacesAPackageWhenAsked) {
  AreaPacking p;
  p.run_area(corner, "corner.farlod");
  p.run_area(middle);
  p.settings.overwrite = Overwrite::replace;
  p.run_area(corner);
  EXPECT_EQ(difference(p.files(), p.files("corner.farlod")), "");
}

TEST(Area, AFolderThatIsNoPackageIsRefused) {
  AreaPacking p;
  fs::create_directories(p.settings.output);
  std::ofstream(p.settings.output / "thesis.txt") << "years";
  EXPECT_THAT(p.refusal(corner), HasSubstr("thesis.txt"));
  fs::remove(p.settings.output / "thesis.txt");
  std::ofstream(p.settings.output / package::manifest_file) << "{";
  EXPECT_THAT(p.refusal(corner), AllOf(HasSubstr("manifest.json is damaged"), HasSubstr("--force")));
}

/// Ends a run at the n-th of its calls of progress in the stage "far maps".
void run_cancelled(AreaPacking& p, const FarMapArea& area, std::size_t after) {
  std::stop_source source;
  p.settings.area = area;
  RunSettings run;
  run.stop = source.get_token();
  std::size_t calls = 0;
  run.on_progress = [&](const Progress& progress) {
    if (progress.stage == "far maps" && ++calls == after) source.request_stop();
  };
  EXPECT_THROW((void)pack(p.settings, p.report, run), Cancelled) << after;
}

TEST(Area, ARunThatIsCancelledLeavesThePackageAsItWas) {
  AreaPacking p;
  p.run_area(corner);
  const auto before = p.files();
  for (const std::size_t after : {1U, 5U, 16U}) {
    run_cancelled(p, all, after);
    EXPECT_EQ(difference(p.files(), before), "");
  }
  p.run_area(all);
  p.run_whole("whole.farlod");
  EXPECT_EQ(difference(p.files(), p.files("whole.farlod")), "");
}

TEST(Area, ARunThatCannotWriteLeavesThePackageAsItWas) {
  AreaPacking p;
  p.run_area(corner);
  const auto before = p.files();
  // A file lets no folder take its name
  const fs::path beside = p.settings.output.string() + ".unfinished";
  std::ofstream(beside) << "somebody's";
  EXPECT_THROW(p.run_area(middle), OutputError);
  EXPECT_TRUE(fs::remove(beside));
  EXPECT_EQ(difference(p.files(), before), "");
}

TEST(Area, AnotherRunMeanwhileIsNotLost) {
  AreaPacking p;
  p.run_area(corner);
  p.settings.area = middle;
  const fs::path manifest = p.settings.output / package::manifest_file;
  const std::string text = scenes::text_of(manifest);
  RunSettings run;
  run.on_progress = [&](const Progress& progress) {
    if (progress.stage == "far maps" && progress.done == 1) std::ofstream(manifest) << scenes::sealed("\n" + text);
  };
  EXPECT_THROW((void)pack(p.settings, p.report, run), OutputError);
  EXPECT_EQ(PackageReader(p.settings.output).manifest().cells_with_far_map(), p.result.package.cells_with_far_map);
  std::ofstream(manifest) << "\n" + text;
  EXPECT_THAT(p.refusal(middle), HasSubstr("manifest.json is damaged: its checksum"));
}

TEST(Area, AnAreaBesideTheCityIsACallersMistake) {
  AreaPacking p;
  try {
    p.run_area(box(5000, 5000, 6000, 6000));
    ADD_FAILURE() << "packed";
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("meets no cell of the grid"), HasSubstr("505000.0,5505000.0 to 506000.0,5506000.0"),
                      HasSubstr("the city from 499985.0,5499985.0 to 500385.0,5500385.0"), HasSubstr("UTM zone 32N")));
  }
  EXPECT_FALSE(fs::exists(p.settings.output));
}

TEST(Area, SaysWhichShapesMeetNoCell) {
  AreaPacking p;
  p.run_area(p.write("stations.csv", "x,y\n500100,5500100\n400000,5500100\n500100,5600100\n"));
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("meet no cell of the grid: 2")));
  EXPECT_EQ(p.result.package.cells_with_far_map, 1U);
}

TEST(Area, AnAreaThatCannotBeReadEndsTheRunBeforeTheCityIsRead) {
  AreaPacking p;
  EXPECT_THROW(p.run_area(p.folder.path() / "lost.gpkg"), InputError);
  EXPECT_FALSE(p.stages_told().contains("ingest"));
}

}  // namespace
}  // namespace farlod::pipeline::test
