// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "base/frame.hpp"
#include "farlod/error.hpp"
#include "results/output_format.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/footprints_text.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Streets of 24 m hold whole pixels, wherever the raster begins.
constexpr double step_m = 4.0;

double mean_difference(const RasterFile& a, const RasterFile& b) {
  double sum = 0.0, count = 0.0;
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    if (!a.values[n] || !b.values.at(n)) continue;
    sum += std::abs(*a.values[n] - *b.values[n]);
    count += 1.0;
  }
  return sum / count;
}

TEST_F(PackedTown, ARunOfLightOnRoofsSaysThatPixelsAreLevel) {
  const auto level = testing::HasSubstr("Pixels are level, also on pitched roofs");
  const std::string light = "farlod-svf a.farlod -o o.tif --grid 20 --period 2026-06-21 --quantity irradiation";
  EXPECT_THAT(folder.run(light + " --on-surface").out, level);
  EXPECT_THAT(folder.run(light).out, testing::Not(level)) << "no pixel is on a roof";
  EXPECT_THAT(folder.run("farlod-svf a.farlod -o o.tif --grid 20 --on-surface").out, testing::Not(level));
}

TEST_F(PackedTown, PixelsLieWhereTheBuildingsAre) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 4");
  const RasterFile map = raster("o.asc");
  EXPECT_EQ(map.step_m, step_m);
  for (const Block& b : small_town()) {
    EXPECT_FALSE(map.at(p_projected(b.centre))) << b.id;
    // A pixel whose centre lies a pixel's diagonal beyond the wall, on each side
    const double beyond = 0.5 * b.edge_m + std::sqrt(2.0) * step_m;
    for (const Point2d side : {Point2d{beyond, 0.0}, {-beyond, 0.0}, {0.0, beyond}, {0.0, -beyond}})
      EXPECT_TRUE(map.at(p_projected(b.centre + side))) << b.id;
  }
}

TEST_F(PackedTown, NoDataCoversTheFootprintsAndNothingElse) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 4");
  const RasterFile map = raster("o.asc");
  const double border_m = 0.001 * std::sqrt(2.0);  // corners are written in whole millimetres
  for (std::size_t n = 0; n < map.values.size(); ++n) {
    const Point2d p_town = GridRotation(town_bearing).grid_from_city(map.centre_of(n) - town_middle);
    const double beyond = std::max(std::abs(p_town.x), std::abs(p_town.y)) - town_half_m;
    if (beyond > 0.0) continue;  // there the grid may end
    double inside_m = -1e9;
    for (const Block& b : small_town()) {
      const Point2d d = p_town - b.centre;
      inside_m = std::max(inside_m, 0.5 * b.edge_m - std::max(std::abs(d.x), std::abs(d.y)));
    }
    if (std::abs(inside_m) > border_m) {
      EXPECT_EQ(map.values[n].has_value(), inside_m < 0.0) << p_town.x << ' ' << p_town.y;
    }
  }
}

TEST_F(PackedTown, APixelIsThePointAtItsCentre) {
  // The reference answers each receiver as if it were alone; for horizons it matters a little who stands beside it
  folder.must("farlod-svf a.farlod -o o.asc --grid 4 --engine exact");
  const RasterFile map = raster("o.asc");
  std::string points = "x,y\n";
  for (std::size_t n = 0; n < map.values.size(); ++n) points += text_of(map.centre_of(n)) + "\n";
  folder.write("p.csv", points);
  folder.must("farlod-svf a.farlod -o o.csv --points p.csv --engine exact");
  const CsvTable answers = table("o.csv");
  ASSERT_EQ(answers.size(), map.values.size());
  std::size_t compared = 0;
  for (std::size_t n = 0; n < map.values.size(); ++n) {
    if (!map.values[n]) continue;
    EXPECT_NEAR(answers.number(n, "svf"), *map.values[n], half_of_last_digit) << n;
    ++compared;
  }
  EXPECT_GT(compared, map.values.size() / 4);
}

/// Readers may keep the decimals of a file of text as doubles.
void expect_same_map(const RasterFile& a, const RasterFile& b) {
  EXPECT_EQ(a.north_west, b.north_west);
  ASSERT_EQ(a.columns, b.columns);
  ASSERT_EQ(a.rows, b.rows);
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    ASSERT_EQ(a.values[n].has_value(), b.values[n].has_value()) << n;
    if (a.values[n]) {
      EXPECT_EQ(static_cast<float>(*a.values[n]), static_cast<float>(*b.values[n])) << n;
    }
  }
}

TEST_F(PackedTown, EachRasterFormatHoldsTheSameMap) {
  folder.must("farlod-svf a.farlod -o map.asc --grid 4");
  for (const OutputFormat& format : output_formats()) {
    if (!format.holds_rasters()) continue;
    SCOPED_TRACE(format.name);
    // No two formats share the files beside a raster
    const std::string ending(format.endings[0]), name = "map_" + ending.substr(1);
    folder.must("farlod-svf a.farlod -o " + name + ending + " --grid 4");
    expect_same_map(raster(name + ending), raster("map.asc"));
#ifdef FARLOD_WITH_GDAL
    // GIS programs read .prj files in Esri's WKT 1; packages have WKT 2
    if (folder.has(name + ".prj"))
      EXPECT_THAT(folder.text_of(name + ".prj"), testing::StartsWith("PROJCS[\"WGS_1984_UTM_Zone_32N\""));
    else
      EXPECT_EQ(raster(name + ending).epsg, 32632);
#endif
  }
}

#ifdef FARLOD_WITH_GDAL
TEST_F(PackedTown, AZarrGroupIsReplacedAndAnotherFolderIsNot) {
  const std::string run = "farlod-svf a.farlod -o map.zarr --quiet --grid ";
  folder.must(run + "8");
  folder.must(run + "4");
  EXPECT_EQ(raster("map.zarr").step_m, 4.0);
  folder.must("mkdir other.zarr && touch other.zarr/mine");
  expect_refusal(folder.run("farlod-svf a.farlod -o other.zarr --grid 4"), exit_unusable_input, {"other.zarr", "no Zarr group"});
  EXPECT_TRUE(folder.has("other.zarr/mine"));
}
#endif

TEST_F(PackedTown, EachPictureFormatIsThatOfThePreview) {
  for (const OutputFormat& format : output_formats()) {
    if (!format.is_picture) continue;
    const std::string ending(format.endings[0]);
    folder.must("farlod-svf a.farlod -o map.asc --grid 4 --preview preview" + ending);
    folder.must("farlod-svf a.farlod -o picture" + ending + " --grid 4");
    EXPECT_FALSE(folder.text_of("picture" + ending).empty()) << format.name;
    EXPECT_TRUE(folder.text_of("picture" + ending) == folder.text_of("preview" + ending)) << format.name;
  }
}

TEST_F(PackedTown, ABoxCutsOutAPartOfTheSameMap) {
  folder.must("farlod-svf a.farlod -o all.asc --grid 4");
  folder.must("farlod-svf a.farlod -o part.asc --grid 4 --bbox 499952,5499960,500060,5500048");
  const RasterFile all = raster("all.asc"), part = raster("part.asc");
  EXPECT_EQ(part.columns, 27U);
  EXPECT_EQ(part.rows, 22U);
  EXPECT_EQ(part.north_west, (Point2d{499952.0, 5500048.0}));
  for (std::size_t n = 0; n < part.values.size(); ++n) EXPECT_EQ(part.values[n], all.at(part.centre_of(n))) << n;
}

TEST_F(PackedTown, RoofsHaveValuesWhenReceiversStandOnThem) {
  folder.must("farlod-svf a.farlod -o o.asc --grid 4 --on-surface --engine exact");
  const RasterFile map = raster("o.asc");
  EXPECT_EQ(map.at(p_projected(tower_of(small_town()).centre)), 1.0);
  for (const Block& b : small_town()) EXPECT_TRUE(map.at(p_projected(b.centre))) << b.id;
}

TEST_F(PackedTown, WithTheWholeTownNearRaysAreExact) {
  folder.must("farlod-pack town.geojson -o near.farlod --neighborhood 21");
  folder.must("farlod-svf near.farlod -o rays.asc --grid 4 --engine rays");
  folder.must("farlod-svf near.farlod -o exact.asc --grid 4 --engine exact");
  const RasterFile rays = raster("rays.asc"), exact = raster("exact.asc");
  // The two scenes round their corners apart, so that a ray along an edge may be lost on one side
  EXPECT_LT(mean_difference(rays, exact), 0.01 / static_cast<double>(default_rays));
}

TEST_F(PackedTown, TheTableOfAVerificationHasTheValuesOfTheRaster) {
  folder.must("farlod-svf a.farlod -o o.tif --grid 4 --verify 30 --verify-map v.csv --summary s.json");
  const CsvTable verified = table("v.csv");
  const RasterFile svf = raster("o.tif");
  ASSERT_EQ(verified.size(), 30U);
  double error_sum = 0.0;
  for (std::size_t n = 0; n < verified.size(); ++n) {
    const auto value = svf.at({verified.number(n, "x_m"), verified.number(n, "y_m")});
    ASSERT_TRUE(value.has_value());
    EXPECT_NEAR(verified.number(n, "svf"), *value, 2.0 * half_of_last_digit);
    EXPECT_NEAR(verified.number(n, "z_m"), 1.5, 0.0005);
    error_sum += std::abs(verified.number(n, "svf") - verified.number(n, "svf_exact"));
  }
  EXPECT_NEAR(folder.json_of("s.json").at("verify").at("mean_abs_error").get<double>(), error_sum / 30.0,
              3.0 * half_of_last_digit);
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all --spacing 12 --verify 30 --verify-map v.pdf --sky solid");
  EXPECT_TRUE(folder.text_of("v.pdf").starts_with("%PDF"));
}

TEST_F(PackedTown, HistogramsAreTheSameForAnyNumberOfThreads) {
  for (const std::string receivers : {"-o o.asc --grid 2", "-o o.csv --surfaces all --spacing 3"}) {
    folder.must("farlod-svf a.farlod --threads 1 --histogram one.svg " + receivers);
    folder.must("farlod-svf a.farlod --threads 4 --histogram four.svg " + receivers);
    EXPECT_NE(folder.text_of("one.svg").find("<title>Distribution of svf</title>"), std::string::npos);
    EXPECT_EQ(folder.text_of("one.svg"), folder.text_of("four.svg")) << receivers;
  }
  folder.must("farlod-svf a.farlod --histogram walls.svg -o o.csv --surfaces walls --spacing 3");
  EXPECT_NE(folder.text_of("walls.svg"), folder.text_of("one.svg"));
}

/// Whatever was asked for, the distribution was that of svf.
TEST_F(PackedTown, HistogramsAreOfTheQuantityThatAPreviewShows) {
  folder.write("p.csv", "x,y\n" + text_of(p_projected({-60.0, 0.0})) + "\n");
  for (const std::string receivers : {"-o o.tif --grid 20", "-o o.csv --surfaces all --spacing 12", "-o o.csv --points p.csv"}) {
    folder.must("farlod-svf a.farlod --histogram h.svg --quantity irradiation --period 2026-06-21 " + receivers);
    EXPECT_NE(folder.text_of("h.svg").find("<title>Distribution of irradiation</title>"), std::string::npos) << receivers;
    folder.must("farlod-svf a.farlod --histogram h.svg --quantity irradiation,svf --period 2026-06-21 " + receivers);
    EXPECT_NE(folder.text_of("h.svg").find("<title>Distribution of svf</title>"), std::string::npos) << receivers;
  }
}

TEST_F(PackedTown, VerifyTellsTheErrorOfTheFarMap) {
  const double border = 4.0 * std::numbers::pi;
  std::vector<double> mean_errors;
  for (const int neighborhood : {1, 3, 21}) {
    const std::string n = std::to_string(neighborhood);
    folder.must("farlod-pack town.geojson -o n.farlod --force --far-map box --neighborhood " + n);
    folder.must("farlod-svf n.farlod -o o.asc --grid 4 --verify 200 --summary s.json");
    const nlohmann::json verify = folder.json_of("s.json").at("verify");
    EXPECT_EQ(verify.at("count"), 200);
    EXPECT_GE(verify.at("rays"), 20000);
    EXPECT_LE(std::abs(verify.at("bias").get<double>()), verify.at("mean_abs_error").get<double>());
    EXPECT_LE(verify.at("mean_abs_error"), verify.at("p99_abs_error"));
    EXPECT_LE(verify.at("p99_abs_error"), verify.at("max_abs_error"));
    mean_errors.push_back(verify.at("mean_abs_error"));
    if (neighborhood == 3) {
      EXPECT_LT(verify.at("max_abs_error"), paper_error);
    }
    if (neighborhood == 21) {
      EXPECT_LT(verify.at("max_abs_error"), sampling_error(default_rays, border));
    }
  }
  EXPECT_GT(mean_errors[0], mean_errors[1]);
  EXPECT_GT(mean_errors[1], mean_errors[2]);
}

TEST_F(PackedTown, VerifyTracesManyMoreRaysThanTheRun) {
  const std::string run = "farlod-svf a.farlod -o o.asc --grid 20 --engine exact --verify 20 --summary s.json --rays ";
  folder.must(run + "100");
  EXPECT_GT(folder.json_of("s.json").at("verify").at("mean_abs_error"), 0.0);
  folder.must(run + "20000");
  EXPECT_EQ(folder.json_of("s.json").at("verify").at("max_abs_error"), 0.0) << "the same rays";
}

TEST_F(PackedTown, ThreadsChangeNothing) {
  folder.must("farlod-svf a.farlod -o one.asc --grid 4 --threads 1 --summary one.json");
  folder.must("farlod-svf a.farlod -o four.asc --grid 4 --threads 4 --summary four.json");
  EXPECT_EQ(raster("one.asc").values, raster("four.asc").values);
  EXPECT_EQ(folder.text_of("one.asc"), folder.text_of("four.asc"));
  EXPECT_EQ(folder.json_of("one.json").at("svf"), folder.json_of("four.json").at("svf"));
}

/// The small town with cells of 20 m, whole as `a.farlod`, and as `part.farlod` with far maps for a part.
class TownWithAnArea : public testing::Test {
 protected:
  TownWithAnArea() {
    add_packed_town(folder, "small_cells", small_town(), "--cell 20");
    folder.must("farlod-pack town.geojson -o part.farlod --cell 20 --quiet --area " + text_of(south_west) + "," +
                text_of(north_east));
  }
  /// Of all bands. The files as a whole differ, since they name their package and their settings.
  [[nodiscard]] std::vector<std::optional<double>> values_in(const std::string& file) const {
    std::vector<std::optional<double>> values;
    for (std::size_t band = 1; band <= band_names(folder.path(file)).size(); ++band) {
      const RasterFile raster = read_raster(folder.path(file), static_cast<int>(band));
      values.insert(values.end(), raster.values.begin(), raster.values.end());
    }
    return values;
  }
  [[nodiscard]] std::string area() const { return text_of(south_west) + "," + text_of(north_east); }

  Point2d south_west = town_middle + Point2d{-90.0, -60.0}, north_east = town_middle + Point2d{-10.0, 40.0};
  WorkFolder folder;
};

/// Each engine that has a horizon or a ray to lose, in the area and beside it.
TEST_F(TownWithAnArea, AnswersInTheAreaAreThoseOfTheWholePackage) {
  for (const std::string what : {"", " --engine rays", " --bounds", " --max-error 0.01 --bounds", " --engine horizon"}) {
    const std::string map = " --grid 4 --quiet --bbox " + area() + what;
    folder.must("farlod-svf a.farlod -o whole.tif" + map);
    folder.must("farlod-svf part.farlod -o part.tif" + map);
    EXPECT_EQ(values_in("whole.tif"), values_in("part.tif")) << what;
  }
}

TEST_F(TownWithAnArea, AnswersElsewhereAreExact) {
  const std::string far_from_it = " --grid 4 --quiet --bbox " + text_of(town_middle + Point2d{60.0, 80.0}) + "," +
                                  text_of(town_middle + Point2d{100.0, 120.0});
  folder.must("farlod-svf part.farlod -o exact.tif --engine exact" + far_from_it);
  for (const std::string engine : {"", " --engine rays"}) {
    folder.must("farlod-svf part.farlod -o part.tif --summary s.json" + far_from_it + engine);
    EXPECT_EQ(values_in("exact.tif"), values_in("part.tif")) << engine;
    EXPECT_EQ(folder.json_of("s.json").at("receivers_without_far_map"), folder.json_of("s.json").at("receivers"));
    EXPECT_GT(folder.json_of("s.json").at("receivers"), 10);
  }
  folder.must("farlod-svf a.farlod -o whole.tif" + far_from_it);
  EXPECT_NE(values_in("exact.tif"), values_in("whole.tif")) << "horizons and rays round alike: this test sees nothing";
}

TEST_F(TownWithAnArea, BoundsOfExactAnswersAreEqual) {
  folder.write("p.csv", "x,y\n" + text_of(p_projected({120.0, 90.0})) + "\n");
  folder.must("farlod-svf part.farlod -o p_out.csv --points p.csv --bounds --quiet");
  const CsvTable answers(folder.text_of("p_out.csv"));
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_LT(answers.number(0, "svf"), 1.0);
  EXPECT_EQ(answers.number(0, "svf_low"), answers.number(0, "svf"));
  EXPECT_EQ(answers.number(0, "svf_high"), answers.number(0, "svf"));
}

TEST_F(TownWithAnArea, SaysHowManyReceiversHaveNoFarMap) {
  Outcome outcome = folder.run("farlod-svf part.farlod -o o.asc --grid 10 --summary s.json");
  const auto summary = folder.json_of("s.json");
  EXPECT_LT(summary.at("receivers_without_far_map"), summary.at("receivers"));
  EXPECT_THAT(outcome.out,
              HasSubstr(summary.at("receivers_without_far_map").dump() + " receivers lie in cells without a far map"));
  outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 10 --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("receivers_without_far_map"), 0);
  EXPECT_THAT(outcome.out, Not(HasSubstr("without a far map")));
}

TEST_F(TownWithAnArea, SurfacesAndVerificationWorkOnAllCells) {
  folder.must("farlod-svf part.farlod -o walls.csv --surfaces walls --spacing 8 --verify 50 --summary s.json --quiet");
  const auto summary = folder.json_of("s.json");
  EXPECT_GT(summary.at("receivers_without_far_map"), 0);
  EXPECT_LT(summary.at("verify").at("max_abs_error"), 0.02);
}

TEST_F(TownWithAnArea, TheEngineHorizonSendsNoRays) {
  expect_refusal(folder.run("farlod-svf part.farlod -o o.asc --grid 10 --engine horizon"), exit_unusable_input,
                 {"needs a far map", "--area", "engine auto"});
  EXPECT_FALSE(folder.has("o.asc"));
}

TEST_F(TownWithAnArea, TheMemoryOfTheWholeCityIsAskedForBefore) {
  expect_refusal(folder.run("farlod-svf part.farlod -o o.asc --grid 10 --threads 1 --memory-limit 94"), exit_limit_reached,
                 {"tracing the whole city", "cells without a far map"});
  folder.must("farlod-svf a.farlod -o o.asc --grid 10 --threads 1 --memory-limit 94");
}

TEST_F(TownWithAnArea, AFileSaysTheSameAsARectangle) {
  folder.write("area.geojson", scenes::FootprintsText().add("", Box2d{south_west, north_east}).text());
  folder.must("farlod-pack town.geojson -o by_file.farlod --cell 20 --quiet --area area.geojson");
  folder.must("diff -r part.farlod by_file.farlod");
}

TEST_F(TownWithAnArea, SaysHowManyFarMapsThereAre) {
  const Outcome outcome = folder.run("farlod-pack town.geojson -o part.farlod --cell 20 --summary s.json --area " +
                                     text_of(town_middle) + "," + text_of(town_middle + Point2d{1.0, 1.0}));
  const auto summary = folder.json_of("s.json");
  EXPECT_LT(summary.at("cells_with_far_map"), summary.at("cells"));
  EXPECT_THAT(outcome.out,
              HasSubstr("Far maps: " + summary.at("cells_with_far_map").dump() + " of " + summary.at("cells").dump() + " cells"));
}

TEST_F(TownWithAnArea, AnotherCityIsRefused) {
  expect_refusal(folder.run("farlod-pack town.geojson -o part.farlod --cell 25 --area " + area()), exit_unusable_input,
                 {"part.farlod is not the package of these inputs and options", "grid.cell_m", "--force"});
  folder.must("farlod-pack town.geojson -o part.farlod --cell 25 --force --quiet --area " + area());
}

TEST_F(TownWithAnArea, WrongAreasAreRefused) {
  const auto with = [&](const std::string& text) { return folder.run("farlod-pack town.geojson -o n.farlod --area " + text); };
  expect_refusal(with("1,2,3"), exit_usage, {"--area", "give X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1"});
  expect_refusal(with("3,2,1,4"), exit_usage, {"--area", "X0 < X1"});
  expect_refusal(with("1,2,3,4,"), exit_usage, {"--area", "not of the form X0,Y0,X1,Y1"});
  expect_refusal(with("1,2,x,4"), exit_usage, {"--area", "not of the form X0,Y0,X1,Y1"});
  expect_refusal(with("1,2,3,1e300"), exit_usage, {"--area", "lies nowhere on Earth"});
  expect_refusal(with("''"), exit_usage, {"--area", "empty"});
  const Outcome beside = with("1,2,3,4");
  EXPECT_EQ(beside.exit_code, exit_usage);
  EXPECT_THAT(beside.err,
              AllOf(HasSubstr("meets no cell of the grid"), HasSubstr("from 1.0,2.0 to 3.0,4.0"), HasSubstr("UTM zone 32N")));
  expect_refusal(with("lost.gpkg"), exit_unusable_input, {"lost.gpkg does not exist"});
  EXPECT_FALSE(folder.has("n.farlod"));
}

TEST_F(TownWithAnArea, AReaderOfVersion6IsTold) {
  EXPECT_EQ(folder.json_of("part.farlod/manifest.json").at("version"), 10);
  EXPECT_EQ(folder.json_of("a.farlod/manifest.json").at("version"), 10);
}

}  // namespace
}  // namespace farlod::acceptance
