// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/library/library_calls.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::library {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

struct WrongPack {
  std::string name;
  std::function<void(PackSettings&)> change;
};

std::vector<WrongPack> wrong_files() {
  const auto origin = [](const Point3d& p) { return [p](PackSettings& s) { s.obj_origin = p; }; };
  return {{"no output", [](PackSettings& s) { s.output.clear(); }},
          {"no inputs", [](PackSettings& s) { s.inputs.clear(); }},
          {"an input without a name", [](PackSettings& s) { s.inputs.emplace_back(); }},
          {"a terrain without a name", [](PackSettings& s) { s.terrain = {""}; }},
          {"trees without a name", [](PackSettings& s) { s.trees.files.emplace_back(); }},
          {"a canopy without a name", [](PackSettings& s) { s.trees.canopy = ""; }},
          {"trunks without a canopy", [](PackSettings& s) { s.trees.trunks = "trunks.tif"; }},
          {"heights of no kind", [](PackSettings& s) { s.trees.heights = static_cast<CanopyHeights>(2); }},
          {"crowns of nothing", [](PackSettings& s) { s.trees.trunk_ratio = 1.0; }},
          {"crowns at no height", [](PackSettings& s) { s.trees.trunk_ratio = not_a_number; }},
          {"no such overwrite", [](PackSettings& s) { s.overwrite = static_cast<Overwrite>(5); }},
          {"no such policy", [](PackSettings& s) { s.problems = static_cast<ProblemPolicy>(-1); }},
          {"an empty name of ground",
           [](PackSettings& s) {
             s.ground_names = {"lot", ""};
           }},
          {"no such axis", [](PackSettings& s) { s.up = static_cast<UpAxis>(2); }},
          {"lod -1", [](PackSettings& s) { s.lod = -1; }},
          {"lod 4", [](PackSettings& s) { s.lod = 4; }},
          {"an origin at no place", origin({0.0, not_a_number, 0.0})},
          {"an origin without end", origin({endless, 0.0, 0.0})},
          {"an origin beyond the Earth", origin({0.0, 0.0, 1e10})},
          {"a storey of nothing", [](PackSettings& s) { s.footprints.floor_height_m = 0.0; }},
          {"a storey at no height", [](PackSettings& s) { s.footprints.floor_height_m = not_a_number; }},
          {"houses of nothing", [](PackSettings& s) { s.footprints.default_height_m = 0.0; }},
          {"houses without end", [](PackSettings& s) { s.footprints.default_height_m = endless; }}};
}

std::vector<WrongPack> wrong_grids() {
  std::vector<WrongPack> list{{"no such alignment", [](PackSettings& s) { s.align = static_cast<AlignMode>(3); }},
                              {"no such assignment", [](PackSettings& s) { s.assign = static_cast<Assign>(2); }},
                              {"no such far map", [](PackSettings& s) { s.far_map = static_cast<FarMapKind>(2); }},
                              {"a bearing at no angle", [](PackSettings& s) { s.fixed_bearing = Angle::degrees(not_a_number); }},
                              {"a bearing of two turns", [](PackSettings& s) { s.fixed_bearing = Angle::degrees(720.0); }},
                              {"an error of box maps", [](PackSettings& s) {
                                 s.max_error = 0.01;
                                 s.far_map = FarMapKind::box;
                               }}};
  for (const double edge_m : {not_a_number, endless, 0.0, -50.0, 0.1, 1e6})
    list.push_back({"cells of " + std::to_string(edge_m), [edge_m](PackSettings& s) { s.cell_edge_m = edge_m; }});
  for (const int n : {0, -3, 2, 4, 1001})
    list.push_back({"neighborhood " + std::to_string(n), [n](PackSettings& s) { s.neighborhood = n; }});
  for (const double e : {not_a_number, endless, 0.0, -0.1, 2.0})
    list.push_back({"max_error " + std::to_string(e), [e](PackSettings& s) { s.max_error = e; }});
  return list;
}

std::vector<WrongPack> wrong_areas() {
  const auto box = [](double x0, double y0, double x1, double y1) {
    return [=](PackSettings& s) { s.area = Box2d{{x0, y0}, {x1, y1}}; };
  };
  return {{"an area without a name", [](PackSettings& s) { s.area = std::filesystem::path(); }},
          {"an empty area", [](PackSettings& s) { s.area = Box2d{}; }},
          {"an area that runs back", box(2.0, 0.0, 1.0, 1.0)},
          {"an area without width", box(1.0, 0.0, 1.0, 1.0)},
          {"an area at no place", box(0.0, not_a_number, 1.0, 1.0)},
          {"an area without end", box(0.0, 0.0, 1.0, endless)},
          {"an area beyond the Earth", box(0.0, 0.0, 1e10, 1.0)},
          {"an area beside the city", box(0.0, 0.0, 1.0, 1.0)}};
}

void expect_refused(const WrongPack& wrong) {
  const scenes::TemporaryFolder folder;
  PackSettings settings = village_settings(folder.path() / "village.farlod");
  wrong.change(settings);
  Report report;
  try {
    (void)pack(settings, report);
    ADD_FAILURE() << wrong.name << " was packed";
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find(": "), std::string::npos) << wrong.name << ": " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << wrong.name << ": " << error.what();
  }
  EXPECT_TRUE(folder.names().empty()) << wrong.name << " left something behind";
}

TEST(WrongPacks, AreRefusedBeforeAnythingIsDone) {
  for (const WrongPack& wrong : wrong_files()) expect_refused(wrong);
  for (const WrongPack& wrong : wrong_grids()) expect_refused(wrong);
  for (const WrongPack& wrong : wrong_areas()) expect_refused(wrong);
}

/// Runs that end before their end.
class EndedPack : public testing::Test {
 protected:
  scenes::TemporaryFolder folder_;
  PackSettings settings_ = village_settings(folder_.path() / "village.farlod");
  Report report_;
  RunSettings run_;
};

TEST_F(EndedPack, RunSettingsThatAreNone) {
  run_.threads = 5000;
  EXPECT_THROW(pack(settings_, report_, run_), InvalidArgument);
  run_ = {};
  run_.memory_limit_mib = 0;
  EXPECT_THROW(pack(settings_, report_, run_), InvalidArgument);
  run_.memory_limit_mib = 1;
  EXPECT_THROW(pack(settings_, report_, run_), LimitReached);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(EndedPack, InputsThatAreNotThere) {
  settings_.inputs = {"/nowhere/town.gml"};
  EXPECT_THROW(pack(settings_, report_), InputError);
  settings_ = village_settings("/proc/nowhere/village.farlod");
  EXPECT_THROW(pack(settings_, report_), OutputError);
}

/// Whatever stage it is in: the folder does not open as a package. The last stage is left at its begin, for its last call comes
/// when all is done.
TEST_F(EndedPack, CancelledInEachStage) {
  std::vector<std::string> stages;
  run_.on_progress = [&](const Progress& p) {
    if (stages.empty() || stages.back() != p.stage) stages.emplace_back(p.stage);
  };
  (void)pack(settings_, report_, run_);
  ASSERT_GE(stages.size(), 5U);
  for (const std::string& stage : stages) {
    settings_.output = folder_.path() / (stage + ".farlod");
    std::stop_source stop;
    run_.stop = stop.get_token();
    run_.on_progress = [&](const Progress& p) {
      if (p.stage == stage && p.done == 0) stop.request_stop();
    };
    EXPECT_THROW(pack(settings_, report_, run_), Cancelled) << stage;
    EXPECT_THROW(Package{settings_.output}, PackageUnusable) << stage;
  }
}

TEST_F(EndedPack, APackageThatIsToBeReplacedStaysUntilItsSuccessorIsBegun) {
  (void)pack(settings_, report_);
  settings_.overwrite = Overwrite::replace;
  std::stop_source stop;
  run_.stop = stop.get_token();
  run_.on_progress = [&](const Progress& p) {
    if (p.stage == "tiles") stop.request_stop();
  };
  EXPECT_THROW(pack(settings_, report_, run_), Cancelled);
  EXPECT_NO_THROW(Package{settings_.output});
}

/// What is wrong with one city is no fault of the next.
TEST_F(EndedPack, ProblemsOfEarlierPacksCountForThoseAlone) {
  report_.add({problem_descriptions.front().code, "earlier.gml", "1", "of another city"});
  settings_.problems = ProblemPolicy::refuse;
  EXPECT_NO_THROW((void)pack(settings_, report_));
}

TEST_F(EndedPack, ACallbackThatThrows) {
  struct Thrown {};
  settings_.overwrite = Overwrite::replace;
  run_.on_progress = [](const Progress& p) {
    if (p.stage == "far maps") throw Thrown();
  };
  EXPECT_THROW(pack(settings_, report_, run_), Thrown);
  EXPECT_THROW(Package{settings_.output}, PackageUnusable);
  run_ = {};
  EXPECT_THROW(pack(settings_, report_, run_, [](const PackEstimate&) { throw Thrown(); }), Thrown);
}

TEST(WrongPackages, PackagesThatAreNone) {
  const PackedSample sample;
  EXPECT_THROW(Package(""), PackageUnusable);
  EXPECT_THROW(Package("/nowhere/town.farlod"), PackageUnusable);
  EXPECT_THROW(Package(sample.settings().inputs.front()), PackageUnusable);
  EXPECT_THROW(Package(sample.folder() / "blocks"), PackageUnusable);
  EXPECT_THROW(Package(std::string(5000, 'a')), PackageUnusable) << "longer than a name can be";
  std::filesystem::resize_file(sample.folder() / "manifest.json", 100);
  EXPECT_THROW(Package{sample.folder()}, PackageDamaged);
}

/// Of cells of 1.6 cm, 100,000 km are more than have numbers.
TEST(WrongPackages, PointsBeyondAllCells) {
  const PackedSample sample;
  const std::filesystem::path manifest = sample.folder() / "manifest.json";
  std::string text;
  std::getline(std::ifstream(manifest), text, '\0');
  const std::string small_cells = std::regex_replace(text, std::regex("\"cell_m\": *[0-9.e+-]+"), "\"cell_m\": 0.015625");
  ASSERT_NE(small_cells, text);
  std::ofstream(manifest) << scenes::sealed(small_cells);
  const Package package(sample.folder());
  const Point2d p = middle_of(package);
  for (const Point2d far : {Point2d{9.9e7, p.y}, {-9.9e7, p.y}, {p.x, 9.9e7}, {p.x, -9.9e7}}) {
    const std::vector<double> x{p.x, far.x}, y{p.y, far.y};
    try {
      (void)evaluate_points(package, {x, y});
      ADD_FAILURE() << far.x << ' ' << far.y << " was taken";
    } catch (const InvalidPoint& error) {
      EXPECT_EQ(error.index(), 1U);
      EXPECT_NE(std::string(error.what()).find("index 1 "), std::string::npos) << error.what();
    }
  }
}

TEST(WrongPackages, BlocksThatAreDamaged) {
  const PackedSample sample;
  const Package package(sample.folder());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sample.folder() / "blocks"))
    if (entry.is_regular_file()) std::filesystem::resize_file(entry.path(), 50);
  const RasterPlan whole = plan_raster(package, 8.0);
  EXPECT_THROW((void)evaluate_raster(package, whole), PackageDamaged);
  EXPECT_THROW((void)evaluate_surfaces(package, {}), PackageDamaged);
}

// Quantities and regions that a caller gets wrong: each ends with InvalidArgument, whatever the run.

class WrongQuantities : public testing::Test {
 protected:
  template <class Change>
  static void expect_refused(const std::vector<Named>& calls, const std::string& name, const Change& change) {
    for (const Named& named : calls) {
      Arguments arguments(PackedSample::shared().folder());
      change(arguments);
      EXPECT_THROW(named.call(arguments), InvalidArgument) << named.name << ": " << name;
    }
  }
  const std::vector<Named> all_{points_into, points, tiles, raster, surfaces};
};

TEST_F(WrongQuantities, AreRefused) {
  const auto with = [](auto member, auto value) { return [=](Arguments& a) { a.settings.further.*member = value; }; };
  const auto sun = [](const SunPosition& position) { return [=](Arguments& a) { a.settings.further.sun = {position}; }; };
  using Q = Quantities;
  expect_refused(all_, "too few horizons", with(&Q::horizons, std::size_t{3}));
  expect_refused(all_, "too many horizons", with(&Q::horizons, std::size_t{3601}));
  expect_refused(all_, "no such patches", with(&Q::sky_patches, static_cast<SkyPatchSet>(9)));
  expect_refused(all_, "a sun nowhere", sun({Angle::degrees(nan), {}, 1.0}));
  expect_refused(all_, "a sun in the ground", sun({{}, Angle::degrees(-91.0), 1.0}));
  expect_refused(all_, "a sun of no time", sun({{}, {}, -1.0}));
  for (const auto member : {&Q::directional, &Q::svf_solid, &Q::hidden})
    expect_refused(all_, "by solid angle", [=](Arguments& a) {
      a.settings.weight = SkyWeight::solid_angle;
      a.settings.further.*member = true;
    });
}

TEST_F(WrongQuantities, BoundsAreOfWhatIsComputed) {
  expect_refused(all_, "bounds of svf_total without svf_total", [](Arguments& a) {
    a.settings.further.svf_total_bounds = true;
    a.settings.bounds = true;
    a.low = a.high = a.svf;
  });
}

TEST_F(WrongQuantities, NeedRoomForThemselvesAndNoOther) {
  expect_refused({points_into}, "no room for quantities", [](Arguments& a) { a.settings.further.directional = true; });
  expect_refused({points_into}, "room that nobody asked for", [](Arguments& a) { a.further.resize(2); });
}

TEST_F(WrongQuantities, RegionsMayBeEmpty) {
  Arguments arguments(PackedSample::shared().folder());
  arguments.settings.region = std::make_shared<const Region>(std::vector<Region::Ring>{});
  const PointAnswers answers = evaluate_points(arguments.package, {arguments.x, arguments.y}, {}, arguments.settings);
  EXPECT_EQ(answers.summary.outside_of_region, arguments.x.size());
  EXPECT_EQ(answers.summary.receivers + answers.summary.no_data, 0U);
  const Raster map = evaluate_raster(arguments.package, arguments.plan, {}, arguments.settings);
  EXPECT_EQ(map.summary.receivers, 0U);
  EXPECT_EQ(map.summary.outside_of_region + map.summary.beyond_grid, arguments.plan.columns * arguments.plan.rows);
}

}  // namespace
}  // namespace farlod::library
