// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/shadow_patches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "evaluate/traced_patches.hpp"
#include "package/manifest.hpp"

namespace farlod {
namespace {

/// Some turns and a sum of 153 of them.
constexpr double rounding_deg = 1e-10;
/// Floats of length 1.
constexpr double rounding_of_floats = 1e-7;

TEST(ShadowPatches, FillBandsFromTheHorizonUpwards) {
  std::vector<std::pair<long, std::size_t>> bands;  // elevation, patches
  for (const ShadowPatch& patch : shadow_patches()) {
    const long elevation = std::lround(patch.elevation.degrees());
    if (bands.empty() || bands.back().first != elevation) bands.emplace_back(elevation, 0);
    ++bands.back().second;
  }
  EXPECT_EQ(bands, (std::vector<std::pair<long, std::size_t>>{
                       {6, 31}, {18, 30}, {30, 28}, {42, 24}, {54, 19}, {66, 13}, {78, 7}, {90, 1}}));
}

TEST(ShadowPatches, BeginWhereUmepHasThemAndFollowClockwise) {
  const auto azimuth = [](std::size_t n) { return shadow_patches()[n].azimuth.degrees(); };
  const std::map<std::size_t, double> first_of_bands{{0, 0.0},   {31, 4.0},  {61, 2.0},   {89, 5.0},
                                                     {113, 8.0}, {132, 0.0}, {145, 10.0}, {152, 0.0}};
  for (const auto& [first, azimuth_deg] : first_of_bands) EXPECT_NEAR(azimuth(first), azimuth_deg, rounding_deg);
  EXPECT_NEAR(azimuth(1), 360.0 / 31.0, rounding_deg);
  EXPECT_NEAR(azimuth(60), 352.0, rounding_deg);
  // The last of 28 patches: 2° + 27 · 360° / 28
  EXPECT_NEAR(azimuth(88), 2.0 + 27.0 * 360.0 / 28.0, rounding_deg);
  double sum_deg = 0.0;
  for (const ShadowPatch& patch : shadow_patches()) {
    EXPECT_GE(patch.azimuth.degrees(), 0.0);
    EXPECT_LT(patch.azimuth.degrees(), 360.0);
    sum_deg += patch.azimuth.degrees();
  }
  // n patches from a on: n a + 180 (n − 1). None passes the full turn
  EXPECT_NEAR(sum_deg, 180.0 * (153.0 - 8.0) + 30.0 * 4.0 + 28.0 * 2.0 + 24.0 * 5.0 + 19.0 * 8.0 + 7.0 * 10.0,
              153 * rounding_deg);
}

TEST(ShadowPatches, LookToTrueNorthWhereTheGridDoesNot) {
  package::Manifest manifest;
  const PatchDirections level = patch_directions(manifest);
  EXPECT_NEAR(level[0].x, 0.0, rounding_of_floats);
  EXPECT_NEAR(level[0].y, std::cos(Angle::degrees(6.0).radians()), rounding_of_floats);
  EXPECT_NEAR(level[0].z, std::sin(Angle::degrees(6.0).radians()), rounding_of_floats);
  EXPECT_NEAR(level[152].z, 1.0, rounding_of_floats);
  // True azimuth = grid azimuth + convergence
  manifest.convergence = Angle::degrees(4.0);
  const PatchDirections turned = patch_directions(manifest);
  EXPECT_NEAR(turned[31].x, 0.0, rounding_of_floats);
  EXPECT_GT(turned[31].y, 0.9);
}

TEST(ShadowPatches, AreBitsOfWholeNumbers) {
  std::vector<float> columns(shadow_column_count, 0.0F);
  EXPECT_EQ(columns.size(), 21U);
  columns[0] = 1.0F;
  columns[7 + 6] = static_cast<float>(1U << 8U);
  columns[14] = 16'777'215.0F;
  EXPECT_TRUE(shadow_value(columns, ShadowMatrix::building, 0));
  EXPECT_FALSE(shadow_value(columns, ShadowMatrix::building, 1));
  EXPECT_TRUE(shadow_value(columns, ShadowMatrix::vegetation, 152));
  EXPECT_FALSE(shadow_value(columns, ShadowMatrix::vegetation, 151));
  for (std::size_t patch = 0; patch < 24; ++patch)
    EXPECT_TRUE(shadow_value(columns, ShadowMatrix::vegetation_before_building, patch)) << patch;
  EXPECT_FALSE(shadow_value(columns, ShadowMatrix::vegetation_before_building, 24));
}

}  // namespace
}  // namespace farlod
