// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_frame.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

TEST(SvfBands, AreTheQuantityAndItsBounds) {
  std::string names;
  for (const Band& band : svf_bands("svf_solid", RasterBands::svf_and_bounds)) {
    names += band.name + " ";
    EXPECT_EQ(band.unit, "1");
    EXPECT_THAT(band.definition, testing::HasSubstr("share of the solid angle"));
  }
  EXPECT_EQ(names, "svf_solid svf_solid_low svf_solid_high ");
  ASSERT_EQ(svf_bands("svf", RasterBands::svf).size(), 1U);
  EXPECT_THAT(svf_bands("svf", RasterBands::svf)[0].definition, testing::StartsWith("sky view factor"));
}

TEST(BandsOf, AreInTheOrderOfTheFrame) {
  const RasterTile one({}, RasterBands::svf), three({}, RasterBands::svf_and_bounds);
  ASSERT_EQ(bands_of(one).size(), 1U);
  EXPECT_EQ(bands_of(one)[0].data(), one.svf.data());
  ASSERT_EQ(bands_of(three).size(), svf_bands("svf", RasterBands::svf_and_bounds).size());
  EXPECT_EQ(bands_of(three)[1].data(), three.low.data());
  EXPECT_EQ(bands_of(three)[2].data(), three.high.data());
}

}  // namespace
}  // namespace farlod
