// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/raster_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

AsciiGrid grid_of(std::size_t columns, std::size_t rows, std::vector<std::optional<double>> values) {
  return {columns, rows, 1.0, {100.0, 200.0}, std::move(values)};
}

/// Ten columns and rows, whose values count up.
AsciiGrid counting() {
  AsciiGrid grid = grid_of(10, 10, std::vector<std::optional<double>>(100));
  for (std::size_t n = 0; n < 100; ++n) grid.values[n] = static_cast<double>(n);
  return grid;
}

TEST(RasterComparison, EqualRastersDoNotDiffer) {
  const RasterDifference d = compare_rasters(counting(), counting());
  EXPECT_EQ(d.count, 100U);
  EXPECT_EQ(d.bias, 0.0);
  EXPECT_DOUBLE_EQ(d.correlation, 1.0);
  EXPECT_EQ(d.max_abs, 0.0);
}

TEST(RasterComparison, FiguresAreThoseOfTheirNames) {
  const AsciiGrid reference = grid_of(2, 2, {0.0, 1.0, 2.0, 3.0}), raster = grid_of(2, 2, {1.0, 1.0, 2.0, 5.0});
  const RasterDifference d = compare_rasters(raster, reference);
  EXPECT_EQ(d.bias, 0.75);
  EXPECT_EQ(d.max_abs, 2.0);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(5.0 / 4.0));
  // Σ(a − ā)(b − b̄) = 6.5, Σ(a − ā)² = 10.75, Σ(b − b̄)² = 5
  EXPECT_DOUBLE_EQ(d.correlation, 6.5 / std::sqrt(10.75 * 5.0));
}

TEST(RasterComparison, NinetyNineOfAHundredAreNoLarger) {
  AsciiGrid raster = counting(), reference = counting();
  for (std::size_t n = 0; n < 100; ++n) *raster.values[n] -= static_cast<double>(100 - n);
  const RasterDifference d = compare_rasters(raster, reference);
  EXPECT_EQ(d.p99_abs, 99.0);
  EXPECT_EQ(d.max_abs, 100.0);
  EXPECT_EQ(d.bias, -50.5);
}

TEST(RasterComparison, TheRimIsLeftOut) {
  AsciiGrid raster = counting();
  raster.values[10 * 1 + 4] = 1000.0;  // the second row
  EXPECT_EQ(compare_rasters(raster, counting(), {.rim = 1}).max_abs, 1000.0 - 14.0);
  const RasterDifference inside = compare_rasters(raster, counting(), {.rim = 2});
  EXPECT_EQ(inside.count, 36U);
  EXPECT_EQ(inside.max_abs, 0.0);
  EXPECT_EQ(compare_rasters(raster, counting(), {.rim = 5}).count, 0U);
}

TEST(RasterComparison, PlacesAreComparedNotIndices) {
  // The middle 3 × 2 pixels of the raster, two from the west and three from the south
  AsciiGrid reference = grid_of(3, 2, {52.0, 53.0, 54.0, 62.0, 63.0, 64.0});
  reference.south_west_m = {102.0, 203.0};
  const RasterDifference part = compare_rasters(counting(), reference);
  EXPECT_EQ(part.count, 6U);
  EXPECT_EQ(part.max_abs, 0.0);
  EXPECT_EQ(compare_rasters(reference, counting()).count, 6U);
  EXPECT_EQ(compare_rasters(reference, counting()).max_abs, 0.0);
}

TEST(RasterComparison, PixelsThatLieAcrossAreRefused) {
  AsciiGrid shifted = counting(), coarse = counting();
  shifted.south_west_m.x += 0.5;
  coarse.step_m = 2.0;
  EXPECT_THROW((void)compare_rasters(shifted, counting()), std::runtime_error);
  EXPECT_THROW((void)compare_rasters(coarse, counting()), std::runtime_error);
}

TEST(RasterComparison, PixelsWithoutAValueDoNotCount) {
  AsciiGrid raster = counting(), reference = counting();
  raster.values[0].reset();
  reference.values[1].reset();
  EXPECT_EQ(compare_rasters(raster, reference).count, 98U);
}

TEST(RasterComparison, HeightsChoosePixels) {
  const AsciiGrid height = counting();
  EXPECT_EQ(compare_rasters(counting(), counting(), {.height = &height, .low_m = 20.0}).count, 80U);
  EXPECT_EQ(compare_rasters(counting(), counting(), {.height = &height, .high_m = 20.0}).count, 20U);
  EXPECT_EQ(compare_rasters(counting(), counting(), {.rim = 1, .height = &height, .high_m = 20.0}).count, 8U);
}

class AsciiGridFile : public testing::Test {
 protected:
  [[nodiscard]] AsciiGrid read(const std::string& text) const {
    std::ofstream(folder_.file("grid.asc")) << text;
    return read_ascii_grid(folder_.file("grid.asc"));
  }

 private:
  scenes::TemporaryFolder folder_;
};

TEST_F(AsciiGridFile, IsReadFromTheNorthWest) {
  const AsciiGrid grid =
      read("NCOLS 3\nnrows 2\nxllcorner 1.5\nyllcorner -2\ncellsize 0.5\nNODATA_value -9999\n1 2.5 -9999\n4 5e-1 -2\n");
  EXPECT_EQ(grid.columns, 3U);
  EXPECT_EQ(grid.rows, 2U);
  EXPECT_EQ(grid.step_m, 0.5);
  EXPECT_EQ(grid.south_west_m.x, 1.5);
  EXPECT_EQ(grid.south_west_m.y, -2.0);
  EXPECT_EQ(grid.at(1, 0), 2.5);
  EXPECT_EQ(grid.at(2, 0), std::nullopt);
  EXPECT_EQ(grid.at(1, 1), 0.5);
}

TEST_F(AsciiGridFile, MustHaveItsHeadAndItsValues) {
  EXPECT_THROW((void)read("ncols 2\nnrows 1\ncellsize 1\n1 2\n"), std::runtime_error);
  EXPECT_THROW((void)read("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n1 2 3\n"),
               std::runtime_error);
  EXPECT_THROW((void)read_ascii_grid("no_such_file.asc"), std::runtime_error);
}

}  // namespace
}  // namespace farlod
