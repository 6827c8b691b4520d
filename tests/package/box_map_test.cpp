// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/box_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace farlod {
namespace {

/// Square and oblong texels, maps of one texel a side, a hamlet's map and a map beside a tower.
constexpr BoxMap shapes[] = {{64, 64, 1.0F}, {1, 1, 0.3F}, {7, 5, 11.43F}, {3, 200, 100.0F}, {200, 3, 1e-4F}, {256, 256, 0.2F}};

TEST(BoxMap, TexelOfIsTheInverseOfDirectionOf) {
  for (const BoxMap& map : shapes)
    for (std::uint32_t row = 0; row < map.rows; ++row)
      for (std::uint32_t column = 0; column < map.columns(); ++column) {
        const Texel texel{column, row};
        ASSERT_EQ(map.texel_of(map.direction_of(texel)), texel) << "row " << row << ", column " << column;
      }
}

TEST(BoxMap, EveryDirectionOfATexelIsWithinHalfATexelOfItsMiddle) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  for (const BoxMap& map : shapes)
    for (int step = 0; step < 20000; ++step) {
      const double azimuth = 2.0 * std::numbers::pi * step / 20000;
      const double reach = std::max(std::abs(std::sin(azimuth)), std::abs(std::cos(azimuth)));
      const double up = static_cast<double>(map.top) * std::fmod(step * std::numbers::phi, 1.0);
      const Point3d d{std::sin(azimuth) / reach, std::cos(azimuth) / reach, up};
      const auto texel = map.texel_of(d);
      ASSERT_TRUE(texel);
      const Point3d middle = map.direction_of(*texel);
      EXPECT_LE(std::max(std::abs(d.x - middle.x), std::abs(d.y - middle.y)), 1.0 / map.side_columns + rounding);
      EXPECT_LE(std::abs(d.z - middle.z), map.top * (0.5 / map.rows + rounding));
    }
}

TEST(BoxMap, LengthDoesNotMatter) {
  for (const BoxMap& map : shapes) {
    const Texel texel{map.columns() - 1, map.rows - 1};
    for (const double length : {0.125, 8.0, 1024.0}) EXPECT_EQ(map.texel_of(length * map.direction_of(texel)), texel);
  }
}

TEST(BoxMap, TheBoxHasNoLidAndNoFloor) {
  for (const BoxMap& map : shapes) {
    const double top = map.top, below_top = std::nextafter(top, 0.0);
    for (const Point2d side : {Point2d{1, 0.3}, {-0.3, 1}, {-1, -0.3}, {0.3, -1}}) {
      EXPECT_EQ(map.texel_of({side.x, side.y, top}), std::nullopt);
      EXPECT_EQ(map.texel_of({side.x, side.y, -1e-300}), std::nullopt);
      ASSERT_TRUE(map.texel_of({side.x, side.y, below_top}));
      EXPECT_EQ(map.texel_of({side.x, side.y, below_top})->row, map.rows - 1);
      ASSERT_TRUE(map.texel_of({side.x, side.y, 0.0}));
      EXPECT_EQ(map.texel_of({side.x, side.y, 0.0})->row, 0U);
    }
    EXPECT_EQ(map.texel_of({0.0, 0.0, 1.0}), std::nullopt);
    EXPECT_EQ(map.texel_of({0.0, 0.0, -1.0}), std::nullopt);
    EXPECT_EQ(map.texel_of({0.0, 0.0, 0.0}), std::nullopt);
  }
}

TEST(BoxMap, TheSidesAreEastNorthWestSouth) {
  constexpr BoxMap map{10, 4, 1.0F};
  const auto side_of = [&](double x, double y) { return map.texel_of({x, y, 0.1})->column / map.side_columns; };
  EXPECT_EQ(side_of(1, 0), static_cast<std::uint32_t>(BoxSide::east));
  EXPECT_EQ(side_of(0, 1), static_cast<std::uint32_t>(BoxSide::north));
  EXPECT_EQ(side_of(-1, 0), static_cast<std::uint32_t>(BoxSide::west));
  EXPECT_EQ(side_of(0, -1), static_cast<std::uint32_t>(BoxSide::south));
}

TEST(BoxMap, TheVerticalEdgesBelongToEastAndWest) {
  constexpr BoxMap map{10, 4, 1.0F};
  EXPECT_EQ(map.texel_of({1, -1, 0.1})->column, 0U);    // first of the east side
  EXPECT_EQ(map.texel_of({1, 1, 0.1})->column, 9U);     // its last
  EXPECT_EQ(map.texel_of({-1, 1, 0.1})->column, 20U);   // first of the west side
  EXPECT_EQ(map.texel_of({-1, -1, 0.1})->column, 29U);  // its last
}

TEST(BoxMap, ColumnsRunCounterClockwiseFromTheSouthEast) {
  constexpr BoxMap map{10, 4, 1.0F};
  std::uint32_t before = 0;
  for (int step = 1; step < 1000; ++step) {
    const double turned = 2.0 * std::numbers::pi * (step / 1000.0 - 0.125);
    const std::uint32_t column = map.texel_of({std::cos(turned), std::sin(turned), 0.1})->column;
    EXPECT_TRUE(column == before || column == before + 1) << "column " << column << " follows " << before;
    before = column;
  }
  EXPECT_EQ(before, map.columns() - 1);
}

}  // namespace
}  // namespace farlod
