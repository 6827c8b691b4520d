// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/wall_pixels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace farlod {
namespace {

/// A surface, and what is found of its walls.
struct Walls {
  std::size_t edge;
  std::vector<float> surface_m, height_m, aspect_deg;

  /// `height_m` gets the column and the row of a pixel's centre from the north-west.
  Walls(std::size_t pixels, const std::function<double(double, double)>& height_of, double step_m = 1.0) : edge(pixels) {
    for (std::size_t row = 0; row < edge; ++row)
      for (std::size_t column = 0; column < edge; ++column)
        surface_m.push_back(static_cast<float>(height_of(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5)));
    const WallSurface surface{edge, edge, step_m, surface_m};
    height_m = wall_heights(surface);
    aspect_deg = wall_aspects(surface, height_m);
  }
  [[nodiscard]] float height(std::size_t column, std::size_t row) const { return height_m[row * edge + column]; }
  [[nodiscard]] float aspect(std::size_t column, std::size_t row) const { return aspect_deg[row * edge + column]; }
};

double between_turns(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360.0)); }

/// A filter of 9 pixels knows a line by a few degrees where walls of two directions are in it.
constexpr double filter_deg = 8.0;

TEST(WallPixels, StandOutsideOfASquareTowerAndFaceAwayFromIt) {
  // Columns and rows 10 to 29 are 12 m high
  const Walls walls(40, [](double x, double y) { return 10 < x && x < 30 && 10 < y && y < 30 ? 12.0 : 0.0; });
  for (std::size_t n = 10; n < 30; ++n) {
    EXPECT_EQ(walls.height(n, 9), 12.0F);
    const double allowed = n < 14 || n > 25 ? filter_deg : 0.0;
    EXPECT_LE(between_turns(walls.aspect(n, 9), 0.0), allowed) << "the northern wall, " << n;
    EXPECT_LE(between_turns(walls.aspect(30, n), 90.0), allowed) << "the eastern wall, " << n;
    EXPECT_LE(between_turns(walls.aspect(n, 30), 180.0), allowed) << "the southern wall, " << n;
    EXPECT_LE(between_turns(walls.aspect(9, n), 270.0), allowed) << "the western wall, " << n;
  }
  EXPECT_EQ(std::ranges::count(walls.height_m, 12.0F), 80);
  EXPECT_EQ(std::ranges::count(walls.height_m, 0.0F), 1600 - 80) << "neither corners nor the tower itself";
}

TEST(WallPixels, FaceTheDirectionsOfATowerThatIsTurned) {
  constexpr double turn = 30.0 * std::numbers::pi / 180.0, half = 20.0, middle = 40.0;
  const Walls walls(80, [](double x, double y) {
    const double east = x - middle, north = middle - y;
    const double along = std::cos(turn) * east - std::sin(turn) * north, across = std::sin(turn) * east + std::cos(turn) * north;
    return std::max(std::abs(along), std::abs(across)) < half ? 15.0 : 0.0;
  });
  constexpr double corner = 6.0;
  std::size_t count = 0;
  for (std::size_t row = 0; row < walls.edge; ++row)
    for (std::size_t column = 0; column < walls.edge; ++column) {
      if (walls.height(column, row) == 0.0F) continue;
      const double east = static_cast<double>(column) + 0.5 - middle, north = middle - static_cast<double>(row) - 0.5;
      const double along = std::cos(turn) * east - std::sin(turn) * north,
                   across = std::sin(turn) * east + std::cos(turn) * north;
      if (std::min(std::abs(along), std::abs(across)) > half - corner) continue;
      // The side to the north faces 30° clockwise of it
      const double expected = std::abs(across) > std::abs(along) ? (across > 0.0 ? 30.0 : 210.0) : (along > 0.0 ? 120.0 : 300.0);
      EXPECT_LE(between_turns(walls.aspect(column, row), expected), filter_deg) << column << ' ' << row;
      ++count;
    }
  EXPECT_GT(count, 80U);
}

TEST(WallPixels, FaceEachOtherAcrossAStreet) {
  // A street of 8 pixels from west to east between walls of 10 and 6 m
  const Walls walls(40, [](double, double y) { return y < 16 ? 10.0 : y > 24 ? 6.0 : 0.0; });
  for (std::size_t column = 5; column < 35; ++column) {
    EXPECT_EQ(walls.height(column, 16), 10.0F);
    EXPECT_EQ(walls.aspect(column, 16), 180.0F);
    EXPECT_EQ(walls.height(column, 23), 6.0F);
    EXPECT_EQ(walls.aspect(column, 23), 0.0F);
    EXPECT_EQ(walls.height(column, 20), 0.0F);
  }
}

TEST(WallPixels, LeaveOutLowStepsTheRimAndWhereThereIsNoSurface) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> surface_m{9, 9, 9,    9,    9, 9,  //
                                     9, 0, 0,    0,    0, 9,  //
                                     9, 0, 2.9F, 0,    0, 9,  //
                                     9, 0, 0,    none, 0, 9,  //
                                     9, 9, 9,    9,    9, 9};
  const std::vector<float> wall_m = wall_heights({6, 5, 1.0, surface_m});
  const std::vector<float> expected_m{0, 0, 0, 0,    0, 0,  //
                                      0, 9, 9, 9,    9, 0,  //
                                      0, 9, 0, 0,    9, 0,  //
                                      0, 9, 9, 0.0F, 9, 0,  //
                                      0, 0, 0, 0,    0, 0};
  EXPECT_EQ(wall_m, expected_m);
  const std::vector<float> exactly_m{0, 0, 0, 0, 0, 3, 0, 0, 0};
  EXPECT_EQ(wall_heights({3, 3, 1.0, exactly_m})[4], 3.0F) << "as high as the limit";
}

TEST(WallPixels, LookAtNineMetres) {
  EXPECT_EQ(aspect_reach(1.0), 4U);
  EXPECT_EQ(aspect_reach(0.5), 9U);
  EXPECT_EQ(aspect_reach(2.0), 2U);
  EXPECT_EQ(aspect_reach(3.0), 1U);
  EXPECT_EQ(aspect_reach(10.0), 1U);
}

/// The filter, pixel by pixel and line by line, as its description says.
double aspect_by_force(const Walls& walls, int column, int row) {
  const auto at = [&](const std::vector<float>& values, int c, int r) {
    const bool exists = 0 <= c && 0 <= r && c < static_cast<int>(walls.edge) && r < static_cast<int>(walls.edge);
    return exists ? static_cast<double>(values[static_cast<std::size_t>(r) * walls.edge + static_cast<std::size_t>(c)]) : -1.0;
  };
  std::vector<int> most_lines;
  int most = 0;
  const auto is_on = [](int azimuth, int east, int south) {
    const double turn = azimuth * std::numbers::pi / 180.0;
    return std::abs(east * std::cos(turn) + south * std::sin(turn)) < 0.5;
  };
  for (int azimuth = 0; azimuth > -180; --azimuth) {
    int walls_on_line = 0;
    for (int south = -4; south <= 4; ++south)
      for (int east = -4; east <= 4; ++east)
        if (is_on(azimuth, east, south) && at(walls.height_m, column + east, row + south) > 0.0) ++walls_on_line;
    if (walls_on_line > most) most_lines.clear(), most = walls_on_line;
    if (walls_on_line == most) most_lines.push_back(azimuth);
  }
  // Only one run of neighbours, across the end of the list or not, is compared
  const auto gaps = std::ranges::count_if(most_lines, [&](int azimuth) {
    const int next = azimuth == -179 ? 0 : azimuth - 1;
    return std::ranges::find(most_lines, next) == most_lines.end();
  });
  if (gaps != 1) return -1.0;
  double x = 0.0, y = 0.0;  // lines have no direction: twice their azimuths have
  for (const int azimuth : most_lines) {
    x += std::cos(2.0 * azimuth * std::numbers::pi / 180.0);
    y += std::sin(2.0 * azimuth * std::numbers::pi / 180.0);
  }
  return std::fmod(0.5 * std::atan2(y, x) * 180.0 / std::numbers::pi + 180.0, 180.0);
}

TEST(WallPixels, RunAlongTheLinesThatBruteForceFinds) {
  std::mt19937 random(7);
  const auto below = [&random](unsigned int end) { return static_cast<double>(random() % end); };
  std::vector<std::array<double, 4>> boxes;
  for (int n = 0; n < 25; ++n) {
    const double x = below(90), y = below(90), width = 4.0 + below(20);
    boxes.push_back({x, y, x + width, y + 4.0 + below(20)});
  }
  const Walls walls(100, [&](double x, double y) {
    double height_m = 0.0;
    for (std::size_t n = 0; n < boxes.size(); ++n)
      if (boxes[n][0] < x && x < boxes[n][2] && boxes[n][1] < y && y < boxes[n][3])
        height_m = std::max(height_m, 5.0 + static_cast<double>(n));
    return height_m;
  });
  std::size_t compared = 0;
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 100; ++column) {
      if (walls.height(static_cast<std::size_t>(column), static_cast<std::size_t>(row)) == 0.0F) continue;
      const double line_deg = aspect_by_force(walls, column, row);
      if (line_deg < 0.0) continue;
      const double aspect_deg = walls.aspect(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
      // A wall faces across its line
      EXPECT_NEAR(std::abs(std::remainder(aspect_deg - 90.0 - line_deg, 180.0)), 0.0, 1e-3) << column << ' ' << row;
      ++compared;
    }
  EXPECT_GT(compared, 300U);
}

}  // namespace
}  // namespace farlod
