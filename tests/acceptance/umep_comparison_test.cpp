// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include "tests/acceptance/raster_file.hpp"
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

/// What the comparison is asked to hold: two programs that agree on what a sky view factor is.
constexpr double largest_bias = 0.01, least_correlation = 0.995;
/// A wall stands on the side of its pixel with us, and half a pixel farther with UMEP, which shifts shadows by whole pixels. A
/// march of UMEP's kind over the pixels (64 azimuths; .0003 from UMEP's on the ground) and one over blocks differ by .021 there.
constexpr double largest_bias_on_ground = 0.02;
/// Nothing in this part of Göteborg is between 6 and 8 m high: below lies the ground, above lie the roofs.
constexpr const char *on_ground = " --below 7", *on_roofs = " --above 7";
/// UMEP sees nothing beyond the raster, and neither do we; nothing can be said of its outermost pixels.
constexpr std::size_t rim = 1;

/// UMEP's receivers stand on the surface. On a facet between a yard and a roof, steeper than 20 : 1, ours need some centimetres
/// to be a millimetre off it, which is where rays begin.
constexpr const char* arguments = " --grid 1 --on-surface --height 0.05 --quiet -o svf.asc";

/// What validation/compare_rasters.py prints.
struct RasterDifference {
  std::size_t count = 0;
  double bias = 0.0, correlation = 0.0;
};

class UmepComparison : public RealCity {
 protected:
  void SetUp() override {
    needs({"goteborg/dsm.asc", "goteborg/svf_umep.asc"});
    if (IsSkipped()) return;
    folder.must("farlod-pack --terrain " + data("goteborg/dsm.asc") + " --crs EPSG:3007 --quiet -o a.farlod");
    surface = read_raster(data("goteborg/dsm.asc"));
  }
  void evaluate(const std::string& engine) const { folder.must("farlod-svf a.farlod --engine " + engine + arguments); }

  /// What was evaluated beside UMEP's.
  [[nodiscard]] RasterDifference difference(const std::string& pixels = "") const {
    folder.must(FARLOD_SOURCE_DIR "/validation/compare_rasters.py svf.asc " + data("goteborg/svf_umep.asc") + " --height " +
                data("goteborg/dsm.asc") + " --rim " + std::to_string(rim) + pixels + " > difference.txt");
    RasterDifference d;
    EXPECT_EQ(std::sscanf(folder.text_of("difference.txt").c_str(), "%zu | %lf | %lf", &d.count, &d.bias, &d.correlation), 3);
    return d;
  }
  [[nodiscard]] std::size_t compared_pixels() const { return (surface.columns - 2 * rim) * (surface.rows - 2 * rim); }

  RasterFile surface;
};

TEST_F(UmepComparison, WhatAUserGetsAgrees) {
  evaluate("auto");
  const RasterDifference d = difference();
  EXPECT_EQ(d.count, compared_pixels());
  EXPECT_LE(std::abs(d.bias), largest_bias);
  EXPECT_GE(d.correlation, least_correlation);
}

TEST_F(UmepComparison, TheWholeCityAgrees) {
  evaluate("exact");
  const RasterDifference d = difference();
  EXPECT_LE(std::abs(d.bias), largest_bias);
  EXPECT_GE(d.correlation, least_correlation);
}

/// Patches at walls differ, which UMEP has half a pixel farther away: 1.8 %. One band that begins 4° later makes 2.3 % of it.
constexpr double least_share_of_same_patches = 0.981;
/// UMEP's rasters are rounded to five digits, and its weights to whole degrees.
constexpr double largest_rms_of_same_patches = 0.0002;

TEST_F(UmepComparison, ThePatchesOfTheSkyAreItsOwn) {
  folder.must("farlod-svf a.farlod --on-surface --height 0.05 --quiet -o kit.solweig");
  folder.must(FARLOD_SOURCE_DIR "/validation/umep_patches " + data("goteborg/dsm.asc") + " kit.solweig " +
              data("goteborg/svf_umep.asc") + " > patches.txt");
  double same = 0.0, bias = 0.0, rms = 1.0;
  ASSERT_EQ(std::sscanf(folder.text_of("patches.txt").c_str(), "%lf | %lf | %lf", &same, &bias, &rms), 3);
  EXPECT_GE(same, least_share_of_same_patches);
  EXPECT_LE(rms, largest_rms_of_same_patches);
}

TEST_F(UmepComparison, WhatSolweigGetsHasAValueForEachPixelOfTheSurfaceModel) {
  folder.must("farlod-svf a.farlod --grid-like " + data("goteborg/dsm.asc") + " --on-surface --height 0.05 --quiet -o svfs.zip");
  const RasterFile svf = read_raster(folder.path("svfs.zip"));
  ASSERT_EQ(svf.values.size(), surface.columns * surface.rows);
  // The map of the package has these pixels, too, since they begin at whole metres, and more around them
  evaluate("auto");
  const RasterFile by_step = read_raster(folder.path("svf.asc"));
  for (std::size_t n = 0; n < svf.values.size(); ++n) {
    const std::optional<double> expected = by_step.at(svf.centre_of(n));
    ASSERT_TRUE(svf.values[n] && expected) << n;
    ASSERT_NEAR(*svf.values[n], *expected, 1e-6) << n;
  }
}

TEST_F(UmepComparison, NeitherGroundNorRoofsAreOff) {
  evaluate("auto");
  const RasterDifference ground = difference(on_ground), roofs = difference(on_roofs);
  EXPECT_EQ(ground.count + roofs.count, compared_pixels());
  EXPECT_LE(std::abs(ground.bias), largest_bias_on_ground);
  EXPECT_LE(std::abs(roofs.bias), largest_bias);
}

}  // namespace
}  // namespace farlod::acceptance
