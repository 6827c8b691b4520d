// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/acceptance/raster_file.hpp"
#include "tests/acceptance/real_city.hpp"
#include "validation/raster_comparison.hpp"

namespace farlod::acceptance {
namespace {

/// What the comparison is asked to hold: two programs that agree on what a sky view factor is.
constexpr double largest_bias = 0.01, least_correlation = 0.995;
/// Nothing in this part of Göteborg is between 6 and 8 m high: below lies the ground, above lie the roofs.
constexpr double between_ground_and_roofs_m = 7.0;
/// UMEP sees nothing beyond the raster, and neither do we. Our ground ends at the outermost pixels' centres.
constexpr std::size_t rim = 1;

/// UMEP's receivers stand on the surface. On a facet between a yard and a roof, steeper than 20 : 1, ours need some centimetres
/// to be a millimetre off it, which is where rays begin.
constexpr const char* arguments = " --grid 1 --on-surface --height 0.05 --quiet -o svf.asc";

class UmepComparison : public RealCity {
 protected:
  void SetUp() override {
    needs({"goteborg/dsm.asc", "goteborg/svf_umep.asc"});
    if (IsSkipped()) return;
    folder.must("farlod-pack --terrain " + data("goteborg/dsm.asc") + " --crs EPSG:3007 --quiet -o a.farlod");
    surface = read_ascii_grid(data("goteborg/dsm.asc"));
    umep = read_ascii_grid(data("goteborg/svf_umep.asc"));
  }
  [[nodiscard]] AsciiGrid evaluate(const std::string& engine) const {
    folder.must("farlod-svf a.farlod --engine " + engine + arguments);
    return read_ascii_grid(folder.path("svf.asc"));
  }

  AsciiGrid surface, umep;
};

TEST_F(UmepComparison, WhatAUserGetsAgrees) {
  const RasterDifference d = compare_rasters(evaluate("auto"), umep, {.rim = rim});
  EXPECT_EQ(d.count, (surface.columns - 2 * rim) * (surface.rows - 2 * rim));
  EXPECT_LE(std::abs(d.bias), largest_bias);
  EXPECT_GE(d.correlation, least_correlation);
}

TEST_F(UmepComparison, TheWholeCityAgrees) {
  const RasterDifference d = compare_rasters(evaluate("exact"), umep, {.rim = rim});
  EXPECT_LE(std::abs(d.bias), largest_bias);
  EXPECT_GE(d.correlation, least_correlation);
}

TEST_F(UmepComparison, WhatSolweigGetsHasAValueForEachPixelOfTheSurfaceModel) {
  folder.must("farlod-svf a.farlod --grid-like " + data("goteborg/dsm.asc") + " --on-surface --height 0.05 --quiet -o svfs.zip");
  const RasterFile svf = read_raster(folder.path("svfs.zip"));
  ASSERT_EQ(svf.values.size(), surface.columns * surface.rows);
  // The map of the package has these pixels, too, since they begin at whole metres, and more around them
  (void)evaluate("auto");
  const RasterFile by_step = read_raster(folder.path("svf.asc"));
  for (std::size_t n = 0; n < svf.values.size(); ++n) {
    const std::optional<double> expected = by_step.at(svf.centre_of(n));
    ASSERT_TRUE(svf.values[n] && expected) << n;
    ASSERT_NEAR(*svf.values[n], *expected, 1e-6) << n;
  }
}

TEST_F(UmepComparison, NeitherGroundNorRoofsAreOff) {
  const AsciiGrid svf = evaluate("auto");
  const RasterDifference ground =
      compare_rasters(svf, umep, {.rim = rim, .height = &surface, .high_m = between_ground_and_roofs_m});
  const RasterDifference roofs =
      compare_rasters(svf, umep, {.rim = rim, .height = &surface, .low_m = between_ground_and_roofs_m});
  EXPECT_EQ(ground.count + roofs.count, (surface.columns - 2 * rim) * (surface.rows - 2 * rim));
  EXPECT_LE(std::abs(ground.bias), largest_bias);
  EXPECT_LE(std::abs(roofs.bias), largest_bias);
}

}  // namespace
}  // namespace farlod::acceptance
