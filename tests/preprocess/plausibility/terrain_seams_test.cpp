// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/terrain_seams.hpp"

#include <gmock/gmock.h>

#include <functional>

namespace farlod::plausibility {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using HeightAt = std::function<double(Point2d)>;

/// 20 by 20 pixels, of which the south-western one has its corner at `corner`.
TerrainRaster tile(Point2d corner, double step_m, const HeightAt& height_at) {
  TerrainRaster raster{corner + Point2d{0.5 * step_m, 0.5 * step_m}, {step_m, step_m}, 20, 20, {}};
  for (std::size_t row = 0; row < 20; ++row)
    for (std::size_t column = 0; column < 20; ++column)
      raster.height_m.emplace_back(static_cast<float>(height_at(raster.node(column, row))));
  return raster;
}

HeightAt slope(double above_m) {
  return [above_m](Point2d p) { return 500.0 + 0.3 * p.x - 0.2 * p.y + above_m; };
}

TEST(TerrainSeams, TellByHowMuchATileIsHigherThanItsNeighbour) {
  const TerrainRaster west = tile({0.0, 0.0}, 10.0, slope(0.0));
  for (const double above_m : {-46.0, -10.0, -3.5, 3.5, 8.0, 46.0}) {
    const auto seam = seam_between(west, tile({200.0, 0.0}, 10.0, slope(above_m)));
    ASSERT_TRUE(seam.has_value()) << above_m;
    EXPECT_NEAR(seam->step_m, above_m, 1e-3) << "floats of a few hundred metres";
    EXPECT_EQ(seam->is_impossible, std::abs(above_m) > 40.0);
  }
}

TEST(TerrainSeams, AreNoneWhereASlopeGoesOn) {
  const TerrainRaster west = tile({0.0, 0.0}, 10.0, slope(0.0));
  EXPECT_FALSE(seam_between(west, tile({200.0, 0.0}, 10.0, slope(0.0))).has_value());
  EXPECT_FALSE(seam_between(west, tile({200.0, 0.0}, 40.0, slope(0.0))).has_value()) << "coarser: 25 m from node to node";
  EXPECT_FALSE(seam_between(west, tile({100.0, 100.0}, 10.0, slope(1.0))).has_value()) << "upon each other, two surveys";
}

TEST(TerrainSeams, AreFoundWhereTilesLieUponEachOther) {
  const auto seam = seam_between(tile({0.0, 0.0}, 10.0, slope(0.0)), tile({50.0, 50.0}, 5.0, slope(-5.0)));
  ASSERT_TRUE(seam.has_value());
  EXPECT_NEAR(seam->step_m, -5.0, 1e-3);
}

TEST(TerrainSeams, AreNoCliffsHereAndThere) {
  const HeightAt rough = [](Point2d p) { return 500.0 + 30.0 * std::sin(p.y / 10.0) + (p.x > 200.0 ? 4.0 : 0.0); };
  EXPECT_FALSE(seam_between(tile({0.0, 0.0}, 10.0, rough), tile({200.0, 0.0}, 10.0,
                                                                [&](Point2d p) {
                                                                  return rough(p + Point2d{0.0, 12.0});
                                                                }))
                   .has_value());
}

TEST(TerrainSeams, AreNoneBetweenTilesThatDoNotMeet) {
  EXPECT_FALSE(seam_between(tile({0.0, 0.0}, 10.0, slope(0.0)), tile({230.0, 0.0}, 10.0, slope(46.0))).has_value());
}

TEST(BlankTiles, HoldZerosFarBelowAllOthers) {
  const auto flat = [](double height_m) { return tile({0.0, 0.0}, 10.0, [=](Point2d) { return height_m; }); };
  EXPECT_THAT(blank_tiles(std::vector{flat(500.0), flat(0.0), flat(-1.0), flat(20.0)}), ElementsAre(1U, 2U));
  EXPECT_THAT(blank_tiles(std::vector{flat(500.0), flat(0.0), flat(3.0)}), IsEmpty()) << "a coast";
  EXPECT_THAT(blank_tiles(std::vector{flat(0.0), flat(0.0)}), IsEmpty()) << "a sea";
}

}  // namespace
}  // namespace farlod::plausibility
