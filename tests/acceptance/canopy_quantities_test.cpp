// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <map>

#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/street_trees.hpp"

// What farlod-svf computes of the trees of a package.

namespace farlod::acceptance {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The small town, `a.farlod`, and the same with trees in its streets, `b.farlod`.
class TreeTown : public PackedTown {
 protected:
  TreeTown() {
    folder.write("trees.csv", street_trees());
    folder.must("farlod-pack town.geojson --trees trees.csv -o b.farlod --quiet");
  }
  /// The mean of each column over a part of a street.
  [[nodiscard]] std::map<std::string, double> means_in_street(const std::string& arguments) const {
    Box2d street;
    for (const Point2d p_town : {Point2d{-95.0, -8.0}, {95.0, 8.0}}) street.add(p_projected(p_town));
    const std::string box = text_of(street.low) + "," + text_of(street.high);
    folder.must("farlod-svf b.farlod -o street.tif --grid 2 --bbox " + box + " " + arguments);
    std::map<std::string, double> means;
    int band = 0;
    for (const std::string& column : band_names(folder.path("street.tif"))) {
      double sum = 0.0, count = 0.0;
      for (const auto& value : read_raster(folder.path("street.tif"), ++band).values)
        if (value) sum += *value, count += 1.0;
      EXPECT_GT(count, 100.0);
      means[column] = sum / count;
    }
    return means;
  }
};

const std::string under_trees = text_of(p_projected({-60.0, 4.0}));

TEST_F(TreeTown, HasColumnsOfItsCrowns) {
  folder.must("farlod-svf b.farlod -o o.csv --quantity svf_total,svfaveg,shares --summary s.json --at " + under_trees);
  const CsvTable row = table("o.csv");
  EXPECT_THAT(row.header(), ElementsAre("id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf", "svf_total", "svfveg",
                                        "svfaveg", "share_sky", "share_vegetation", "share_building"));
  const auto at = [&](const char* column) { return row.number(0, column); };
  EXPECT_NEAR(at("svf_total"), at("svf") - (1.0 - at("svfveg")) * 0.97, 3.0 * half_of_last_digit);
  EXPECT_NEAR(at("share_sky"), at("svf") + at("svfveg") - 1.0, 3.0 * half_of_last_digit);
  EXPECT_NEAR(at("share_sky") + at("share_vegetation") + at("share_building"), 1.0, 3.0 * half_of_last_digit);
  EXPECT_LT(at("svf_total"), 0.95 * at("svf")) << "it stands beside a tree";
  EXPECT_EQ(folder.json_of("s.json").at("quantities").size(), 6U);
}

TEST_F(TreeTown, HasBoundsOfTheTotalWhereThereAreSomeOfSvf) {
  folder.must(
      "farlod-svf b.farlod -o o.csv --surfaces all --spacing 10 --quantity svf_total --bounds --verify 40 --summary s.json");
  const CsvTable rows = table("o.csv");
  const std::vector<std::string> header = rows.header();
  const auto first = std::ranges::find(header, "svf_total");
  ASSERT_GE(header.end() - first, 4);
  EXPECT_THAT(std::vector(first, first + 4), ElementsAre("svf_total", "svf_total_low", "svf_total_high", "svfveg"));
  double least = 1.0, width = 0.0, count = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (rows.text(n, "svf_total").empty()) continue;
    const double total = rows.number(n, "svf_total"), low = rows.number(n, "svf_total_low"),
                 high = rows.number(n, "svf_total_high");
    EXPECT_LE(low, total);
    EXPECT_LE(total, high);
    least = std::min(least, total);
    width += high - low;
    count += 1.0;
  }
  const auto summary = folder.json_of("s.json");
  EXPECT_NEAR(summary.at("svf_total").at("min"), least, half_of_last_digit);
  EXPECT_NEAR(summary.at("svf_total_bounds").at("mean_width"), width / count, 2.0 * half_of_last_digit);
  EXPECT_EQ(summary.at("svf_total_verify").at("count"), 40U);
  EXPECT_LT(summary.at("svf_total_verify").at("mean_abs_error"), 0.01);
}

TEST_F(TreeTown, KeepsErrorsThatAreAskedForWithItsCrowns) {
  folder.must(
      "farlod-svf b.farlod -o o.csv --surfaces all --spacing 10 --quantity svf_total --max-error 0.005 --verify 60 --summary "
      "s.json");
  EXPECT_LE(folder.json_of("s.json").at("svf_total_verify").at("max_abs_error"), 0.005);
}

TEST_F(TreeTown, SaysTheTotalAtTheEnd) {
  const Outcome run = folder.run("farlod-svf b.farlod -o o.csv --quantity svf_total --at " + under_trees);
  EXPECT_THAT(run.out, HasSubstr("svf_total: 0."));
}

TEST_F(TreeTown, HasTheTotalWhereNobodySaysWhatToCompute) {
  const auto header_of = [&](const std::string& arguments) {
    folder.must("farlod-svf b.farlod -o o.csv --at " + under_trees + " " + arguments);
    return table("o.csv").header();
  };
  EXPECT_THAT(header_of(""), ElementsAre("id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf", "svf_total", "svfveg"));
  EXPECT_THAT(header_of("--bounds"), testing::Contains("svf_total_high"));
  // Else it is told what svf looks through
  EXPECT_THAT(header_of("--quantity svf"), ElementsAre("id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf"));
  EXPECT_THAT(folder.run("farlod-svf b.farlod -o o.asc --grid 8").out, HasSubstr("20 crowns of trees"));
  // Nobody weighs svf_total by solid angle
  const std::string solid = "farlod-svf b.farlod -o o.asc --grid 8 --sky solid";
  EXPECT_THAT(folder.run(solid).out, HasSubstr("--quantity view_factors, or without --sky solid svf_total, counts them."));
  EXPECT_EQ(folder.run("farlod-svf b.farlod -o o.tif --grid 8 --sky solid --quantity view_factors").exit_code, 0);
  EXPECT_THAT(folder.run("farlod-svf a.farlod -o o.asc --grid 8").out, testing::Not(HasSubstr("crowns")));
}

TEST_F(TreeTown, HasHoursOfSunshinePastItsCrownsBesideThoseOfTheOpen) {
  const std::string day = "farlod-svf b.farlod -o o.csv --sun 2026-06-21 --at " + under_trees;
  folder.must(day);
  const CsvTable row = table("o.csv");
  EXPECT_THAT(row.header(), ElementsAre("id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf", "sunlit_h", "sunlit_total_h",
                                        "svf_total", "svfveg"));
  EXPECT_LT(row.number(0, "sunlit_total_h"), row.number(0, "sunlit_h") - 0.5) << "a tree stands to the side";
  folder.must(day + " --transmissivity 1");
  EXPECT_EQ(table("o.csv").number(0, "sunlit_total_h"), row.number(0, "sunlit_h"));
  folder.must("farlod-svf a.farlod -o o.csv --sun 2026-06-21 --at " + under_trees);
  EXPECT_THAT(table("o.csv").header(), testing::Not(testing::Contains("sunlit_total_h")));
  expect_refusal(folder.run("farlod-svf b.farlod -o o.csv --quantity sunlit_total --at " + under_trees), exit_usage,
                 {"sunlit_total needs a day or a year", "--sun"});
}

TEST_F(TreeTown, ThePictureOfTheSkySaysWhatPassesItsCrowns) {
  for (const std::string package : {"a", "b"})
    folder.must("farlod-svf " + package + ".farlod -o " + package + ".svg --sun 2026-06-21 --at " + under_trees);
  // The sky is drawn without its crowns; the words of both differ
  EXPECT_NE(folder.text_of("a.svg"), folder.text_of("b.svg"));
}

TEST_F(TreeTown, PicturesShowTheTotalWhereNobodySaysWhatToDraw) {
  const auto picture_of = [&](const std::string& arguments) {
    folder.must("farlod-svf b.farlod --grid 8 -o " + arguments);
    return folder.text_of("o.png");
  };
  const std::string total = picture_of("o.png");
  EXPECT_TRUE(total == picture_of("o.png --quantity svf_total"));
  EXPECT_TRUE(total == picture_of("o.tif --preview o.png"));
  EXPECT_TRUE(total == picture_of("o.tif --preview o.png --quantity svfaveg,svf_total"));
  EXPECT_FALSE(total == picture_of("o.png --quantity svf"));
  const std::string hours = picture_of("o.tif --sun 2026-06-21 --preview o.png");
  EXPECT_TRUE(hours == picture_of("o.tif --sun 2026-06-21 --quantity sunlit,sunlit_total --preview o.png"));
  EXPECT_FALSE(hours == picture_of("o.tif --sun 2026-06-21 --quantity sunlit --preview o.png"));
}

TEST_F(TreeTown, HasTheSameSkyViewFactorsAsTheTownWithoutTrees) {
  for (const std::string package : {"a", "b"})
    folder.must("farlod-svf " + package + ".farlod -o " + package + ".tif --grid 8 --quantity directional --horizons 8");
  for (int band = 1; band <= 13; ++band)
    EXPECT_EQ(read_raster(folder.path("a.tif"), band).values, read_raster(folder.path("b.tif"), band).values) << band;
}

TEST_F(TreeTown, IsOpenWhereThereAreNone) {
  folder.must("farlod-svf a.farlod -o o.csv --quantity svf_total,svfaveg,shares --at " + under_trees);
  const CsvTable row = table("o.csv");
  EXPECT_NEAR(row.number(0, "svf_total"), row.number(0, "svf"), half_of_last_digit);
  EXPECT_EQ(row.number(0, "svfveg"), 1.0);
  EXPECT_EQ(row.number(0, "svfaveg"), 1.0);
  EXPECT_EQ(row.number(0, "share_vegetation"), 0.0);
}

TEST_F(TreeTown, HasTheFifteenFilesOfUmepForSolweigAndItsTotal) {
  std::vector<std::string> names{"svf"};
  for (const std::string kind : {"", "veg", "aveg"})
    for (const std::string half : {"N", "E", "S", "W"}) names.push_back("svf" + half + kind);
  names.insert(names.end(), {"svfveg", "svfaveg", "svf_total"});
  const auto band = [&](const std::string& name) {
    return read_raster("/vsizip/" + folder.path("svfs.zip").string() + "/" + name + ".tif");
  };
  for (const std::string package : {"b", "a"}) {
    folder.must("farlod-svf " + package + ".farlod -o svfs.zip --grid 8 --leaf-off");
    const std::string zip = folder.text_of("svfs.zip");
    for (const std::string& name : names)
      EXPECT_EQ(zip.find(name + ".tif") != std::string::npos, package == "b" || name.size() <= 4) << package << ' ' << name;
  }
  folder.must("farlod-svf b.farlod -o svfs.zip --grid 8");
  for (const std::string kind : {"", "veg", "aveg"}) {
    const RasterFile whole = band("svf" + kind), north = band("svfN" + kind), south = band("svfS" + kind);
    for (std::size_t n = 0; n < whole.values.size(); ++n) {
      ASSERT_EQ(whole.values[n].has_value(), north.values[n].has_value());
      if (!whole.values[n]) continue;
      EXPECT_NEAR(0.5 * (*north.values[n] + *south.values[n]), *whole.values[n], 2e-6) << kind;
    }
  }
}

TEST_F(TreeTown, HasNoVegetationInItsHalvesWhereThereAreNoTrees) {
  folder.must("farlod-svf a.farlod -o svfs.zip --grid 8 --quantity svf_total,svfaveg,directional_vegetation");
  for (const std::string name : {"svfveg", "svfaveg", "svfNveg", "svfWaveg"})
    for (const auto& value : read_raster("/vsizip/" + folder.path("svfs.zip").string() + "/" + name + ".tif").values)
      EXPECT_EQ(value.value_or(1.0), 1.0) << name;
}

TEST_F(TreeTown, LetsMoreThroughInWinterAndByOtherRules) {
  const auto in_summer = means_in_street("--quantity svf_total");
  const auto mean_with = [&](const std::string& options) {
    return means_in_street("--quantity svf_total " + options).at("svf_total");
  };
  const double summer = in_summer.at("svf_total"), svf = in_summer.at("svf"), winter = mean_with("--leaf-off"),
               opaque = mean_with("--transmissivity 0"), half = mean_with("--transmissivity 0.5"),
               each = mean_with("--canopy-rule crowns --leaf-off"), beer = mean_with("--canopy-rule beer"),
               thin = mean_with("--canopy-rule beer --extinction 0.1");
  EXPECT_LT(opaque, summer);
  EXPECT_LT(summer, winter);
  EXPECT_NEAR(half, winter, 1e-6);
  EXPECT_LT(each, winter);
  EXPECT_LT(beer, thin);
  EXPECT_LT(winter, svf);
}

TEST_F(TreeTown, IsTheSameToAllEngines) {
  const std::string arguments = "--quantity svf_total,svfaveg --rays 20000 ";
  const auto exact = means_in_street(arguments + "--engine exact"), automatic = means_in_street(arguments + "--engine auto"),
             rays = means_in_street(arguments + "--engine rays");
  for (const char* column : {"svf_total", "svfveg", "svfaveg"}) {
    EXPECT_NEAR(automatic.at(column), exact.at(column), 0.002) << column;
    EXPECT_NEAR(rays.at(column), exact.at(column), 0.002) << column;
  }
}

TEST_F(TreeTown, NamesTheRuleInItsResults) {
  folder.must("farlod-svf b.farlod -o o.nc --grid 8 --quantity svf_total --canopy-rule beer --extinction 0.4 --leaf-off");
  EXPECT_THAT(folder.text_of("o.nc"), HasSubstr("--canopy-rule beer --extinction 0.4 --leaf-off"));
}

TEST_F(TreeTown, ShowsItsCrownsInPicturesOfTheSky) {
  const std::string colour_of_crowns = "#008c64";
  for (const std::string package : {"a", "b"})
    folder.must("farlod-svf " + package + ".farlod -o " + package + ".svg --at " + under_trees);
  EXPECT_THAT(folder.colours_of("b.svg"), testing::Contains(colour_of_crowns));
  EXPECT_THAT(folder.colours_of("a.svg"), testing::Not(testing::Contains(colour_of_crowns)));
}

TEST_F(TreeTown, ShowsItsCrownsInItsPlan) {
  for (const std::string package : {"a", "b"}) folder.must("farlod-info " + package + ".farlod --png " + package + ".svg");
  EXPECT_THAT(folder.colours_of("b.svg"), testing::Contains("#008c64"));
  EXPECT_THAT(folder.colours_of("a.svg"), testing::Not(testing::Contains("#008c64")));
}

TEST_F(TreeTown, OptionsThatDoNotFitAreRefused) {
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& said) {
    expect_refusal(folder.run("farlod-svf b.farlod -o o.csv --at 1,2 " + arguments), exit_usage, said);
  };
  refused("--quantity svf_total --transmissivity 3", {"--transmissivity"});
  refused("--quantity svf_total --canopy-rule beer --transmissivity 0.1", {"--transmissivity", "--extinction"});
  refused("--quantity svf_total --extinction 0.1", {"--extinction", "--canopy-rule beer"});
  refused("--quantity svf_total --canopy-rule often", {"--canopy-rule"});
  refused("--leaf-off", {"--leaf-off: this run computes nothing of trees", "--quantity svf_total"});
  refused("--transmissivity 0.1", {"--transmissivity: this run computes nothing of trees"});
  refused("--sky solid --quantity svf_total", {"--quantity", "--sky solid"});
}

// What SOLWEIG takes: the sky view factors of a surface model's pixels, in a ZIP file of GeoTIFF files with UMEP's names.

constexpr std::size_t columns = 40, rows = 25;
constexpr double pixel_step_m = 3.0;

/// A surface model whose pixels begin where those of --grid 3 do not.
class Solweig : public PackedTown {
 protected:
  Solweig() : north_west_(town_middle + Point2d{-61.25, 31.75}) { write_model("dsm.asc", pixel_step_m); }

  void write_model(const std::string& name, double cell_m) const {
    std::string text = fmt::format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n", columns,
                                   rows, north_west_.x, north_west_.y - static_cast<double>(rows) * pixel_step_m, cell_m);
    for (std::size_t n = 0; n < columns * rows; ++n) text += "0 ";
    folder.write(name, text + "\n");
  }
  [[nodiscard]] RasterFile band(const std::string& name) const {
    return read_raster("/vsizip/" + folder.path("svfs.zip").string() + "/" + name);
  }

  Point2d north_west_;
};

TEST_F(Solweig, FilesHaveTheNamesAndThePixelsThatItNeeds) {
  folder.must("farlod-svf a.farlod -o svfs.zip --grid-like dsm.asc --on-surface --height 0.05");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.farlod", "dsm.asc", "svfs.zip", "town.geojson"}));
  const Outcome listed = folder.run("/usr/bin/python3 -m zipfile -l svfs.zip && /usr/bin/python3 -m zipfile -t svfs.zip");
  if (listed.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
  EXPECT_EQ(listed.exit_code, exit_done) << listed.err;
  std::vector<std::string> names;
  for (const std::string& line : lines_of(listed.out))
    if (line.find(".tif ") != std::string::npos) names.push_back(line.substr(0, line.find(' ')));
  EXPECT_THAT(names, ElementsAre("svf.tif", "svfN.tif", "svfE.tif", "svfS.tif", "svfW.tif"));
  for (const std::string& name : names) {
    const RasterFile raster = band(name);
    EXPECT_EQ(raster.columns, columns);
    EXPECT_EQ(raster.rows, rows);
    EXPECT_EQ(raster.step_m, pixel_step_m);
    EXPECT_EQ(raster.north_west, north_west_);
  }
}

TEST_F(Solweig, EachPixelHasAValueAndHalvesAddUp) {
  folder.must("farlod-svf a.farlod -o svfs.zip --grid-like dsm.asc --on-surface --height 0.05");
  const RasterFile svf = band("svf.tif"), east = band("svfE.tif"), west = band("svfW.tif");
  for (std::size_t n = 0; n < columns * rows; ++n) {
    ASSERT_TRUE(svf.values[n] && east.values[n] && west.values[n]) << n;
    EXPECT_NEAR(0.5 * (*east.values[n] + *west.values[n]), *svf.values[n], 1e-6);
  }
}

TEST_F(Solweig, ValuesAreThoseOfPointsInTheMiddleOfPixels) {
  folder.must("farlod-svf a.farlod -o svfs.zip --grid-like dsm.asc");
  const RasterFile svf = band("svf.tif");
  std::string points = "x,y\n";
  std::vector<std::size_t> asked;
  for (std::size_t n = 7; n < columns * rows; n += 83) {
    asked.push_back(n);
    points += fmt::format("{},{}\n", svf.centre_of(n).x, svf.centre_of(n).y);
  }
  folder.write("points.csv", points);
  folder.must("farlod-svf a.farlod -o o.csv --points points.csv");
  const CsvTable answers = table("o.csv");
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const std::optional<double> value = svf.values[asked[k]];
    ASSERT_EQ(value.has_value(), !answers.text(k, "svf").empty()) << k;
    if (!value) continue;
    EXPECT_NEAR(answers.number(k, "svf"), *value, 2.0 * half_of_last_digit);
  }
}

TEST_F(Solweig, ARasterWithoutACrsIsTold) {
  EXPECT_THAT(folder.run("farlod-svf a.farlod -o o.asc --grid-like dsm.asc").out,
              testing::HasSubstr("dsm.asc says no CRS: its pixels were taken to be in that of the package."));
}

TEST_F(Solweig, WhatDoesNotFitIsRefused) {
  const auto refused = [&](const std::string& arguments, int exit_code, const std::vector<std::string>& said) {
    expect_refusal(folder.run("farlod-svf a.farlod " + arguments), exit_code, said);
  };
  refused("-o svfs.zip --grid 5 --sky solid", exit_usage, {"--quantity", "--sky solid"});
  refused("-o svfs.zip --at 1,2", exit_usage, {"-o", "--grid"});
  refused("-o o.asc --grid-like dsm.asc --bbox 0,0,1,1", exit_usage, {"--bbox", "--grid-like"});
  refused("-o o.asc --grid-like lost.asc", exit_unusable_input, {"lost.asc", "does not exist"});
  refused("-o o.asc --grid-like town.geojson", exit_unusable_input, {"town.geojson", "raster"});
}

}  // namespace
}  // namespace farlod::acceptance
