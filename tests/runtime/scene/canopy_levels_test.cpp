// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/canopy_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "farlod/point.hpp"

namespace farlod {
namespace {

constexpr float pixel_m = 1.0F;
const Box2d nearby{{10.0, 10.0}, {22.0, 22.0}}, far_away{{1000.0, 10.0}, {1012.0, 22.0}};

/// A raster of 64 × 64 m whose lower left corner is the origin, turned about it; heights grow to the north-east.
std::vector<Crown> raster(std::uint16_t turn = 0) {
  Crown pixel{0.0F, 0.0F, 2.0F, 0.0F, 0.5F * pixel_m, CrownShape::prism, Foliage::unknown, turn};
  const auto cosine = static_cast<float>(std::cos(pixel.turn_rad())), sine = static_cast<float>(std::sin(pixel.turn_rad()));
  std::vector<Crown> pixels;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      const float x = static_cast<float>(column) + 0.5F, y = static_cast<float>(row) + 0.5F;
      pixel.x_m = x * cosine - y * sine, pixel.y_m = x * sine + y * cosine;
      pixel.top_m = 5.0F + 0.1F * (x + y);
      pixels.push_back(pixel);
    }
  return pixels;
}

double area_m2(const std::vector<Crown>& crowns) {
  double sum = 0.0;
  for (const Crown& c : crowns) sum += 4.0 * std::pow(static_cast<double>(c.half_width_m), 2);
  return sum;
}

TEST(CanopyLevels, FarPixelsAreTheLargestSquares) {
  for (const std::uint16_t turn : {std::uint16_t{0}, std::uint16_t{9000}}) {
    const std::vector<Crown> seen = CanopyLevels(raster(turn), 16.0).seen_from(far_away);
    ASSERT_EQ(seen.size(), 16U);
    for (const Crown& crown : seen) {
      EXPECT_FLOAT_EQ(crown.half_width_m, 8.0F);
      EXPECT_EQ(crown.shape, CrownShape::prism);
      EXPECT_EQ(crown.turn, turn);
    }
    constexpr float mean_m = 5.0F + 0.1F * 16.0F, highest_m = 5.0F + 0.1F * 31.0F;
    EXPECT_GT(seen.front().top_m, mean_m) << "of the lowest 16 × 16 pixels, one sees the higher ones";
    EXPECT_LT(seen.front().top_m, highest_m);
    EXPECT_FLOAT_EQ(seen.front().bottom_m, 2.0F);
  }
}

TEST(CanopyLevels, NearPixelsStayWhatTheyAre) {
  const std::vector<Crown> pixels = raster(), seen = CanopyLevels(pixels).seen_from(nearby);
  EXPECT_LT(seen.size(), pixels.size() * 3 / 4);
  for (const Crown& crown : seen) {
    const double x = std::max({0.0, nearby.low.x - crown.x_m, crown.x_m - nearby.high.x}),
                 y = std::max({0.0, nearby.low.y - crown.y_m, crown.y_m - nearby.high.y});
    const double edge_m = 2.0 * static_cast<double>(crown.half_width_m);
    if (edge_m == pixel_m) continue;
    EXPECT_GE(std::hypot(x, y), PixelMerging{}.edges_away * edge_m) << "a square is that far away";
  }
  for (const Crown& pixel : pixels) {
    if (!nearby.contains({pixel.x_m, pixel.y_m})) continue;
    EXPECT_NE(std::ranges::find(seen, pixel), seen.end());
  }
}

TEST(CanopyLevels, NoAreaIsLost) {
  std::vector<Crown> pixels = raster(20000);
  std::erase_if(pixels, [n = 0](const Crown&) mutable { return ++n * 7 % 10 < 4; });
  const CanopyLevels levels(pixels);
  for (const Box2d& places : {nearby, far_away}) EXPECT_NEAR(area_m2(levels.seen_from(places)) / area_m2(pixels), 1.0, 1e-5);
}

TEST(CanopyLevels, SquaresDoNotDependOnWhichPixelComesFirst) {
  for (const std::uint16_t turn : {std::uint16_t{0}, std::uint16_t{9000}}) {
    const std::vector<Crown> pixels = raster(turn);
    const std::vector<Crown> whole = CanopyLevels(pixels).seen_from(far_away),
                             later = CanopyLevels({pixels.begin() + 1, pixels.end()}).seen_from(far_away);
    std::size_t alike = 0;
    for (const Crown& crown : later) alike += static_cast<std::size_t>(std::ranges::count(whole, crown));
    EXPECT_EQ(alike, 15U) << "all but the square of the first pixel";
  }
}

TEST(CanopyLevels, TreesAndLonePrismsAreNoPixels) {
  std::vector<Crown> trees(100, Crown{0.0F, 0.0F, 2.0F, 8.0F, 3.0F, CrownShape::spheroid, Foliage::unknown, 0});
  trees.push_back({0.0F, 0.0F, 2.0F, 8.0F, 3.0F, CrownShape::prism, Foliage::unknown, 0});
  const CanopyLevels levels(trees);
  EXPECT_FALSE(levels.has_pixels());
  EXPECT_EQ(levels.seen_from(far_away), trees);
}

}  // namespace
}  // namespace farlod
