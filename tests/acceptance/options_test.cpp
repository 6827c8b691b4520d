// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <set>

#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "results/output_format.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/console/help_options.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string a_place() { return text_of(p_projected({-60.0, 0.0})); }

struct Program {
  const char* name;
  std::set<std::string> options;  ///< all of them
};

class EachProgram : public testing::TestWithParam<Program> {
 protected:
  WorkFolder folder;
};

TEST_P(EachProgram, TellsItsVersion) {
  const Outcome outcome = folder.run(std::string(GetParam().name) + " --version");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_EQ(outcome.out, std::string(GetParam().name) + " " + software_version + "\n");
}

TEST(HelpOfSvf, TellsTheReceiversFirst) {
  const std::string help = WorkFolder().run("farlod-svf --help").out;
  EXPECT_LT(help.find("\nReceivers:"), help.find("\nOptions:"));
  EXPECT_EQ(help.find("[Option Group"), std::string::npos);
}

TEST_P(EachProgram, HelpBeginsWithWhatItIsAndWhatToTry) {
  const Outcome outcome = folder.run(std::string(GetParam().name) + " --help");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, StartsWith(std::string(GetParam().name) + " — "));
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_GT(lines.size(), 3U);
  EXPECT_EQ(lines[2], "Try this first:");
  EXPECT_THAT(lines[3], StartsWith("  " + std::string(GetParam().name) + " "));
  EXPECT_EQ(test::options_in(outcome.out), GetParam().options);
  EXPECT_THAT(outcome.out, HasSubstr("\n\nExit codes:\n  0    done\n"));
}

INSTANTIATE_TEST_SUITE_P(
    Options, EachProgram,
    testing::Values(
        Program{"farlod-info",
                {"--help", "--version", "--json", "--check", "--cell", "--cells", "--svf", "--zones", "--zones-layer", "--obj",
                 "--png", "--report", "--summary", "--quiet", "--threads", "--config"}},
        Program{
            "farlod-pack",
            {"--help",         "--version",        "--crs",          "--out-crs",      "--origin",          "--up",
             "--ground-names", "--height-field",   "--base-field",   "--roof-field",   "--storeys-field",   "--lod",
             "--terrain",      "--terrain-offset", "--far-terrain",  "--layer",        "--encoding",        "--unknown-height",
             "--floor-height", "--default-height", "--cell",         "--neighborhood", "--max-error",       "--align",
             "--assign",       "--far-map",        "--area",         "--output",       "--force",           "--report",
             "--strict",       "--summary",        "--memory-limit", "--quiet",        "--threads",         "--config",
             "--resume",       "--shard",          "--merge",        "--trees",        "--trees-layer",     "--tree-height-field",
             "--crown-field",  "--trunk-field",    "--canopy",       "--trunk",        "--canopy-absolute", "--trunk-ratio",
             "--surface"}},
        Program{"farlod-svf", {"--canopy-rule",  "--transmissivity", "--extinction", "--leaf-off",     "--help",
                               "--version",      "--grid",           "--points",     "--surfaces",     "--matrix-threshold",
                               "--height",       "--on-surface",     "--spacing",    "--points-crs",   "--points-layer",
                               "--bbox",         "--output",         "--preview",    "--projection",   "--summary",
                               "--engine",       "--rays",           "--directions", "--azimuths",     "--sky",
                               "--max-error",    "--bounds",         "--verify",     "--memory-limit", "--quiet",
                               "--threads",      "--config",         "--along",      "--mask",         "--quantity",
                               "--horizons",     "--sky-patches",    "--sun",        "--sun-step",     "--city",
                               "--grid-like",    "--dry-run",        "--verify-map", "--histogram",    "--resume",
                               "--shard",        "--merge",          "--weather",    "--period",       "--step",
                               "--linke",        "--sky-model",      "--albedo",     "--by",           "--irradiation-threshold",
                               "--sees",         "--within",         "--matrix",     "--at",           "--energyplus",
                               "--wall-sectors", "--eye-field"}},
        Program{"farlod-view",
                {"--help", "--version", "--port", "--listen", "--export", "--summary", "--quiet", "--threads", "--config"}}),
    [](const auto& program) { return program.param.name + 7; });  // what follows "farlod-"

TEST_F(PackedTown, QuietSaysNothing) {
  for (const std::string command : {"farlod-info a.farlod --check --quiet", "farlod-pack town.geojson -o b.farlod --quiet",
                                    "farlod-svf a.farlod -o o.asc --grid 10 --verify 5 --quiet"}) {
    const Outcome outcome = folder.run(command);
    EXPECT_EQ(outcome.exit_code, exit_done);
    EXPECT_EQ(outcome.out + outcome.err, "") << command;
  }
}

TEST_F(PackedTown, OptionsMayComeFromAFile) {
  folder.write("pack.toml", "cell = 25\nneighborhood = 5\nquiet = true\n");
  folder.must("farlod-pack town.geojson -o from_file.farlod --config pack.toml --summary from_file.json");
  EXPECT_EQ(folder.json_of("from_file.json").at("cell_m"), 25.0);
  EXPECT_EQ(folder.json_of("from_file.json").at("neighborhood"), 5);
  folder.write("svf.toml", "rays = 500\nheight = 3.0\non-surface = true\n");
  folder.must("farlod-svf a.farlod -o from_file.csv --config svf.toml --at " + a_place());
  folder.must("farlod-svf a.farlod -o typed.csv --rays 500 --height 3 --on-surface --at " + a_place());
  EXPECT_EQ(folder.text_of("from_file.csv"), folder.text_of("typed.csv"));
}

/// A dry run of these options: its estimate. Nothing else may be in the folder afterwards.
class DryRun : public PackedTown {
 protected:
  [[nodiscard]] nlohmann::json estimate(const std::string& options) const {
    const std::vector<std::string> before = folder.names();
    folder.must("farlod-svf a.farlod --dry-run --summary s.json " + options);
    const nlohmann::json summary = folder.json_of("s.json");
    std::filesystem::remove(folder.path("s.json"));
    EXPECT_EQ(folder.names(), before);
    return summary.at("estimate");
  }
  /// What is estimated is what a run then takes, more or less.
  void expect_near_run(const std::string& output, const std::string& options) const {
    SCOPED_TRACE(output + options);
    const nlohmann::json estimated = estimate("-o " + output + " " + options);
    folder.must("farlod-svf a.farlod --summary run.json -o " + output + " " + options);
    const double receivers = folder.json_of("run.json").at("receivers").get<double>();
    EXPECT_NEAR(estimated.at("receivers").get<double>(), receivers, 0.35 * receivers);
    const double mib = static_cast<double>(folder.text_of(output).size()) / (1 << 20);
    EXPECT_LT(estimated.at("output_mib").get<double>(), 4.0 * mib);
    EXPECT_GT(estimated.at("output_mib").get<double>(), 0.25 * mib);
    EXPECT_GT(estimated.at("seconds").get<double>(), 0.0);
    EXPECT_GT(estimated.at("memory_mib").get<double>(), 50.0);
    std::filesystem::remove_all(folder.path(output));
    std::filesystem::remove(folder.path("run.json"));
  }
};

TEST_F(DryRun, TellsWhatARasterTakes) {
  for (const OutputFormat& format : output_formats())
    if (format.holds_rasters()) expect_near_run("o" + std::string(format.endings[0]), "--grid 0.5");
}

TEST_F(DryRun, TellsWhatSurfacesTake) { expect_near_run("o.csv", "--surfaces all --spacing 1"); }

TEST_F(DryRun, TellsWhatPointsTake) {
  std::string points = "x,y\n";
  for (int n = 0; n < 20'000; ++n) points += text_of(p_projected({-170.0 + 0.017 * n, 170.0 - 3.4 * (n % 100)})) + "\n";
  folder.write("points.csv", points);
  for (const OutputFormat& format : output_formats())
    if (format.holds_tables()) expect_near_run("o" + std::string(format.endings[0]), "--points points.csv");
}

TEST_F(DryRun, SaysSoInASentence) {
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 1 --dry-run");
  EXPECT_EQ(outcome.exit_code, exit_done);
  EXPECT_THAT(outcome.out, StartsWith("About "));
  EXPECT_THAT(outcome.out, HasSubstr("Nothing was written."));
  // All cells of the run, and those whose receivers were timed: neither is a number of cells that are left out
  const nlohmann::json estimated = estimate("-o o.asc --grid 1");
  EXPECT_THAT(outcome.out, HasSubstr(" in " + estimated.at("cells").dump() + " cells: "));
  EXPECT_THAT(outcome.out, HasSubstr("by the time that " + estimated.at("evaluated_receivers").dump() + " receivers in " +
                                     estimated.at("evaluated_cells").dump() + " of them took"));
  EXPECT_EQ(lines_of(outcome.out).size(), 1U);
}

TEST_F(DryRun, EvaluatesAShareOfASmallTown) {
  for (const char* options : {"-o o.asc --grid 0.5", "-o o.csv --surfaces all --spacing 0.5"}) {
    const nlohmann::json estimated = estimate(options);
    EXPECT_GT(estimated.at("evaluated_receivers"), 100) << options;
    EXPECT_LT(8.0 * estimated.at("evaluated_receivers").get<double>(), 1.1 * estimated.at("receivers").get<double>()) << options;
  }
}

TEST_F(DryRun, KeepsTheMemoryLimit) {
  expect_refusal(folder.run("farlod-svf a.farlod -o o.asc --grid 0.05 --dry-run --memory-limit 60"), exit_limit_reached,
                 {"--memory-limit"});
}

TEST_F(PackedTown, ASummaryRepeatsItsRun) {
  folder.must("farlod-pack town.geojson -o b.farlod --cell 25 --quiet --summary pack.json");
  const std::string manifest = folder.text_of("b.farlod/manifest.json");
  folder.must("rm -r b.farlod && farlod-pack --config pack.json");
  EXPECT_EQ(folder.text_of("b.farlod/manifest.json"), manifest);
  folder.must("farlod-svf a.farlod -o o.csv --rays 500 --on-surface --at " + a_place() + " --summary svf.json");
  EXPECT_EQ(
      folder.json_of("svf.json").at("settings"),
      (nlohmann::json{{"PACKAGE", "a.farlod"}, {"output", "o.csv"}, {"rays", "500"}, {"on-surface", "true"}, {"at", a_place()}}));
  const std::string answer = folder.text_of("o.csv");
  folder.must("rm o.csv && farlod-svf --config svf.json --summary again.json");
  EXPECT_EQ(folder.text_of("o.csv"), answer);
  EXPECT_EQ(folder.json_of("again.json").at("settings"), folder.json_of("svf.json").at("settings"));
  folder.must("farlod-svf --config svf.json -o typed.csv");
  EXPECT_EQ(folder.text_of("typed.csv"), answer);
  folder.must("farlod-info a.farlod --check --summary info.json && farlod-info --config info.json --quiet");
}

TEST_F(PackedTown, JsonThatIsNoSummaryIsRefused) {
  folder.write("other.json", R"({"rays": 500})");
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --config other.json --at " + a_place()), exit_usage,
                 {"--config", "summary of a run", "TOML"});
  folder.write("wrong.json", R"({"settings": {"rayz": "500"}})");
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --config wrong.json --at " + a_place()), exit_usage,
                 {"--config", "rayz"});
}

TEST_F(PackedTown, WhatIsTypedWinsOverTheFile) {
  folder.write("pack.toml", "cell = 25\n");
  folder.must("farlod-pack town.geojson -o b.farlod --config pack.toml --cell 40 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("cell_m"), 40.0);
}

TEST_F(PackedTown, SummaryOfPackTellsTheFiguresOfThePackage) {
  folder.must("farlod-pack town.geojson -o b.farlod --summary s.json");
  const nlohmann::json summary = folder.json_of("s.json");
  EXPECT_EQ(summary.at("buildings"), 36);
  EXPECT_EQ(summary.at("polygons"), 36 * 6);
  EXPECT_EQ(summary.at("problems"), 0);
  EXPECT_NEAR(summary.at("grid_rotation_deg"), town_bearing.degrees(), 0.01);
  EXPECT_GT(summary.at("alignment_strength"), 0.9);
  EXPECT_LE(summary.at("far_map_bytes"), summary.at("package_bytes"));
  EXPECT_GT(summary.at("peak_memory_mib"), 1.0);
}

TEST_F(PackedTown, IsShownToPeopleWhenItIsPacked) {
  const std::string out = folder.run("farlod-pack town.geojson -o b.farlod --out-crs EPSG:31467 --summary s.json").out;
  const nlohmann::json looks = folder.json_of("s.json").at("looks");
  // The central meridian, and the latitude of a northing of 5,500 km by the GRS 80 ellipsoid
  EXPECT_NEAR(looks.at("longitude"), 9.0, 0.002);
  EXPECT_NEAR(looks.at("latitude"), 49.6526, 0.002);
  EXPECT_EQ(looks.at("country"), "Germany");
  EXPECT_EQ(looks.at("heights_m").at("least"), 8.0);
  EXPECT_EQ(looks.at("heights_m").at("tallest"), tower_height_m);
  EXPECT_EQ(looks.at("ground_m"), (nlohmann::json{{"low", 0.0}, {"high", 0.0}, {"from", "nothing"}}));
  EXPECT_THAT(out, AllOf(HasSubstr("Place: latitude 49.65"), HasSubstr("(Germany)"), HasSubstr("Heights: least 8.0 m, median "),
                         HasSubstr("tallest 90.0 m"), HasSubstr("Ground: flat, since neither")));
}

TEST_F(PackedTown, TellsTheShareOfBuildingsThatAreLeftOut) {
  std::string town = footprints_geojson(small_town());
  town.replace(town.find("\"height\""), 8, "\"tallness\"");
  town.replace(town.find("\"floors\""), 8, "\"storage\"");
  folder.write("holes.geojson", town);
  const std::string out = folder.run("farlod-pack holes.geojson -o b.farlod --summary s.json").out;
  EXPECT_THAT(out, HasSubstr("That is 1 of 36 buildings left out (2.8 %); --default-height keeps"));
  EXPECT_EQ(folder.json_of("s.json").at("buildings_left_out"), 1);
}

TEST_F(PackedTown, SecondsOfThePackStagesFitIntoTheTotal) {
  folder.must("farlod-pack town.geojson -o b.farlod --summary s.json");
  const nlohmann::json seconds = folder.json_of("s.json").at("seconds");
  // Blocks are written while the next far maps are baked
  double one_after_the_other = 0.0;
  for (const auto& [stage, value] : seconds.items())
    if (stage != "total" && stage != "package") one_after_the_other += value.get<double>();
  EXPECT_GT(one_after_the_other, 0.0);
  EXPECT_LE(one_after_the_other, seconds.at("total"));
  EXPECT_GT(seconds.at("package"), 0.0);
  EXPECT_LE(seconds.at("package"), seconds.at("total"));
}

TEST_F(PackedTown, SummaryOfSvfCountsPixels) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 10 --summary s.json");
  const nlohmann::json summary = folder.json_of("s.json");
  const RasterFile map = raster("o.asc");
  EXPECT_EQ(summary.at("receivers").get<std::size_t>() + summary.at("nodata").get<std::size_t>(), map.values.size());
  EXPECT_EQ(summary.at("rays"), default_rays);
  const double busy_s = summary.at("seconds").at("scenes").get<double>() + summary.at("seconds").at("evaluate").get<double>();
  EXPECT_DOUBLE_EQ(summary.at("receivers_per_second"), summary.at("receivers").get<double>() / busy_s);
}

TEST_F(PackedTown, SummaryTellsTheFiguresOfTheMap) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 10 --summary s.json");
  double low = 1.0, high = 0.0, sum = 0.0, count = 0.0;
  std::vector<double> all;
  for (const auto& value : raster("o.asc").values) {
    if (!value) continue;
    all.push_back(*value);
    low = std::min(low, *value);
    high = std::max(high, *value);
    sum += *value;
    count += 1.0;
  }
  const nlohmann::json svf = folder.json_of("s.json").at("svf");
  const double rounding = 1e-7;  // a float below 1, next to its shortest decimal
  EXPECT_NEAR(svf.at("min"), low, rounding);
  EXPECT_NEAR(svf.at("max"), high, rounding);
  EXPECT_NEAR(svf.at("mean"), sum / count, rounding);
  std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) / 2));
  EXPECT_NEAR(svf.at("median"), all[(all.size() - 1) / 2], 5e-5 + rounding);
}

TEST_F(PackedTown, ARunSaysThatFewRaysAnswered) {
  const auto told_by = [&](const std::string& package, const std::string& options) {
    const std::string command = "farlod-svf " + package + " -o o.csv --summary s.json --at " + a_place() + " " + options;
    const std::string printed = folder.run(command).out;
    const std::vector<std::string> notes = folder.json_of("s.json").value("notes", std::vector<std::string>());
    for (const std::string& note : notes) EXPECT_THAT(printed, HasSubstr(note + "\n"));
    return notes;
  };
  folder.must("farlod-pack town.geojson -o box.farlod --far-map box");
  const auto box = HasSubstr("of the kind box, which have no horizons"), more_rays = HasSubstr("--rays 20000"),
             thousand = HasSubstr("1,000 rays a receiver answered");
  EXPECT_THAT(told_by("box.farlod", ""), testing::ElementsAre(testing::AllOf(box, thousand, more_rays)));
  EXPECT_THAT(told_by("box.farlod", "--engine horizon"),
              testing::ElementsAre(testing::AllOf(box, thousand, HasSubstr("whatever the engine"), more_rays)));
  EXPECT_THAT(told_by("box.farlod", "--rays 20000"), testing::ElementsAre(testing::AllOf(box, Not(more_rays))));
  const auto few = testing::ElementsAre(testing::AllOf(thousand, more_rays, Not(box)));
  EXPECT_THAT(told_by("a.farlod", "--engine exact"), few);
  EXPECT_THAT(told_by("box.farlod", "--engine exact"),
              testing::ElementsAre(testing::AllOf(thousand, HasSubstr("which trace the same directions"), more_rays, Not(box))));
  EXPECT_THAT(told_by("a.farlod", "--engine rays"), few);
  for (const std::string engine : {"horizon", "exact --rays 20000", "exact --bounds"})
    EXPECT_THAT(told_by("a.farlod", "--engine " + engine), testing::IsEmpty()) << engine;
}

TEST_F(PackedTown, SummaryNamesTheEngine) {
  for (const std::string engine : {"auto", "horizon", "rays", "exact"}) {
    folder.must("farlod-svf a.farlod -o o.csv --summary s.json --at " + a_place() + " --engine " + engine);
    const nlohmann::json summary = folder.json_of("s.json");
    EXPECT_EQ(summary.at("engine"), engine);
    if (engine == "auto" || engine == "horizon") {
      EXPECT_EQ(summary.at("receivers_by_rays"), 0) << "all of the town stands";
    }
    EXPECT_FALSE(summary.contains("verify"));
  }
}

TEST_F(PackedTown, TheSameCityGivesTheSamePackage) {
  folder.must("farlod-pack town.geojson -o one.farlod --threads 1");
  folder.must("farlod-pack town.geojson -o four.farlod --threads 4");
  EXPECT_EQ(folder.run("diff -r one.farlod four.farlod").exit_code, 0);
}

class StartOf : public testing::TestWithParam<const char*> {};

TEST_P(StartOf, LoadsNeitherGdalNorCairo) {
  const WorkFolder folder;
  const Outcome loaded = folder.run("ldd $(command -v " + std::string(GetParam()) + ")");
  EXPECT_THAT(loaded.out, HasSubstr("libembree"));  // or else these are not the libraries of the program
  for (const char* library : {"libgdal", "libnetcdf", "libproj", "libcairo", "libpango"})
    EXPECT_THAT(loaded.out, Not(HasSubstr(library)));
}

INSTANTIATE_TEST_SUITE_P(Modules, StartOf, testing::Values("farlod-svf", "farlod-info", "farlod-view"),
                         [](const auto& program) { return std::string(program.param).substr(sizeof("farlod-") - 1); });

/// The program without the modules of its build: a test puts what it likes in their place.
class WithoutModules : public testing::Test {
 protected:
  WithoutModules() {
    add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
    folder.must("mkdir -p bin lib/farlod && cp $(command -v farlod-svf) bin");
  }
  [[nodiscard]] std::string folder_of_build() const { return "$(dirname $(command -v farlod-svf))/../lib/farlod"; }

  WorkFolder folder;
  const std::string map = "bin/farlod-svf a.farlod --grid 20 --quiet -o ";
};

TEST_F(WithoutModules, TablesAreWritten) {
  folder.must("bin/farlod-svf a.farlod -o o.csv --at 500030,5500010 --quiet");
  EXPECT_TRUE(folder.has("o.csv"));
}

#ifdef FARLOD_WITH_GDAL
TEST_F(WithoutModules, MapsAreRefused) {
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input,
                 {"this needs GDAL", "lib/farlod/farlod_gdal.so", "No such file", "Install Far-LoD with its folder lib/farlod"});
  EXPECT_FALSE(folder.has("o.tif"));
}

TEST_F(WithoutModules, AStrangeLibraryIsNoModule) {
  folder.must("cp $(ldd bin/farlod-svf | sed -n 's/.*libtbb.* => \\([^ ]*\\).*/\\1/p') lib/farlod/farlod_gdal.so");
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input, {"farlod_gdal.so is no module of Far-LoD"});
}

TEST_F(WithoutModules, AModuleOfAnotherVersionIsRefused) {
  folder.must("sed 's/" + std::string(software_version) + "/9.9.9/g' " + folder_of_build() +
              "/farlod_gdal.so > lib/farlod/farlod_gdal.so");
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input,
                 {"farlod_gdal.so is of Far-LoD 9.9.9, and the program of " + std::string(software_version)});
}

TEST_F(WithoutModules, MovedTogetherTheyWork) {
  folder.must("cp " + folder_of_build() + "/*.so lib/farlod && " + map + "o.tif --preview o.png");
  EXPECT_TRUE(folder.has("o.tif"));
  EXPECT_TRUE(folder.has("o.png"));
}
#endif

TEST_F(WithoutModules, PicturesAreRefused) {
  expect_refusal(folder.run(map + "o.png"), exit_unusable_input, {"this needs Cairo and Pango", "lib/farlod/farlod_cairo.so"});
}

}  // namespace
}  // namespace farlod::acceptance
