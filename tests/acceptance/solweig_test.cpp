// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"

// What SOLWEIG takes: the sky view factors of a surface model's pixels, in a ZIP file of GeoTIFF files with UMEP's names.

namespace farlod::acceptance {
namespace {

using testing::ElementsAre;

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
  refused("-o o.asc --grid-like lost.asc", exit_unusable_input, {"lost.asc", "see that it exists"});
  refused("-o o.asc --grid-like town.geojson", exit_unusable_input, {"town.geojson", "raster"});
}

}  // namespace
}  // namespace farlod::acceptance
