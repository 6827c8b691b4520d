// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/wall_pixels.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace farlod {
namespace {

/// A pixel seen from another one: rows count southwards.
struct PixelOffset {
  int row, column;
};

/// A line through a pixel, and the line across it on either side.
struct WallLine {
  std::vector<PixelOffset> along, left, right;
};

constexpr std::size_t line_count = 180;  // one for each degree, counter-clockwise from the column of the pixel
using WallLines = std::array<WallLine, line_count>;

/// A pixel belongs to a line whose distance from its centre is less than half a pixel.
WallLines lines_of(int reach) {
  WallLines lines;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const double turn = std::numbers::pi * static_cast<double>(n) / static_cast<double>(lines.size());
    const double cosine = std::cos(turn), sine = std::sin(turn);
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const double to_left = sine * row - cosine * column, forward = -cosine * row - sine * column;
        if (std::abs(to_left) < 0.5) lines[n].along.push_back({row, column});
        if (std::abs(forward) < 0.5 && to_left >= 0.5) lines[n].left.push_back({row, column});
        if (std::abs(forward) < 0.5 && to_left <= -0.5) lines[n].right.push_back({row, column});
      }
  }
  return lines;
}

/// The middle of the longest run of neighbours among these lines, all of which follow each other in a circle; its first one where
/// all are in it.
double middle_of_longest_run(const std::array<bool, line_count>& is_in) {
  std::size_t best_begin = 0, best_length = 0;
  for (std::size_t begin = 0; begin < line_count; ++begin) {
    if (!is_in[begin] || is_in[(begin + line_count - 1) % line_count]) continue;
    std::size_t length = 1;
    while (is_in[(begin + length) % line_count]) ++length;
    if (length > best_length) best_begin = begin, best_length = length;
  }
  if (best_length == 0) return 0.0;
  return std::fmod(static_cast<double>(best_begin) + 0.5 * static_cast<double>(best_length - 1), line_count);
}

/// A pixel of a surface, and those around it.
class WallPixel {
 public:
  WallPixel(const WallSurface& surface, std::span<const float> wall_m, std::size_t row, std::size_t column)
      : surface_(surface), wall_m_(wall_m), row_(static_cast<int>(row)), column_(static_cast<int>(column)) {}

  [[nodiscard]] float aspect_deg(const WallLines& lines) const {
    std::array<std::size_t, line_count> walls{};
    std::ranges::transform(lines, walls.begin(), [this](const WallLine& line) { return walls_on(line.along); });
    std::array<bool, line_count> has_most{};
    const std::size_t most = *std::ranges::max_element(walls);
    std::ranges::transform(walls, has_most.begin(), [most](std::size_t count) { return count == most; });
    const double line = middle_of_longest_run(has_most);
    const WallLine& across = lines[static_cast<std::size_t>(line)];
    const double left_deg = 270.0 - line, turned_deg = sum_on(across.left) > sum_on(across.right) ? left_deg - 180.0 : left_deg;
    return static_cast<float>(std::fmod(turned_deg + 360.0, 360.0));
  }

 private:
  [[nodiscard]] std::size_t walls_on(const std::vector<PixelOffset>& offsets) const {
    std::size_t count = 0;
    for (const PixelOffset& o : offsets)
      if (exists(o) && wall_m_[place(o)] > 0.0F) ++count;
    return count;
  }
  [[nodiscard]] double sum_on(const std::vector<PixelOffset>& offsets) const {
    double sum_m = 0.0;
    // Pixels without a surface are as low as this one
    const double own_m = static_cast<double>(surface_.height_m[place({0, 0})]);
    for (const PixelOffset& o : offsets)
      if (exists(o) && !std::isnan(surface_.height_m[place(o)]))
        sum_m += static_cast<double>(surface_.height_m[place(o)]) - own_m;
    return sum_m;
  }
  [[nodiscard]] bool exists(const PixelOffset& o) const {
    return 0 <= row_ + o.row && row_ + o.row < static_cast<int>(surface_.rows) && 0 <= column_ + o.column &&
           column_ + o.column < static_cast<int>(surface_.columns);
  }
  [[nodiscard]] std::size_t place(const PixelOffset& o) const {
    return static_cast<std::size_t>(row_ + o.row) * surface_.columns + static_cast<std::size_t>(column_ + o.column);
  }

  const WallSurface& surface_;
  std::span<const float> wall_m_;
  int row_, column_;
};

}  // namespace

std::vector<float> wall_heights(const WallSurface& surface) {
  std::vector<float> wall_m(surface.columns * surface.rows, 0.0F);
  for (std::size_t row = 1; row + 1 < surface.rows; ++row)
    for (std::size_t column = 1; column + 1 < surface.columns; ++column) {
      float highest_m = -std::numeric_limits<float>::infinity();
      for (const float m :
           {surface.at(row - 1, column), surface.at(row + 1, column), surface.at(row, column - 1), surface.at(row, column + 1)})
        highest_m = std::fmax(highest_m, m);
      // No comparison holds where the pixel has no surface
      const float height_m = highest_m - surface.at(row, column);
      if (height_m >= least_wall_m) wall_m[row * surface.columns + column] = height_m;
    }
  return wall_m;
}

std::size_t aspect_reach(double step_m) {
  constexpr double filter_m = 9.0, rounding = 1e-9;
  const auto pixels = static_cast<std::size_t>(filter_m / step_m + rounding);
  return std::max<std::size_t>(pixels / 2, 1);
}

std::vector<float> wall_aspects(const WallSurface& surface, std::span<const float> wall_m) {
  const WallLines lines = lines_of(static_cast<int>(aspect_reach(surface.step_m)));
  std::vector<float> aspect_deg(wall_m.size(), 0.0F);
  oneapi::tbb::parallel_for(std::size_t{0}, surface.rows, [&](std::size_t row) {
    for (std::size_t column = 0; column < surface.columns; ++column)
      if (const std::size_t pixel = row * surface.columns + column; wall_m[pixel] > 0.0F)
        aspect_deg[pixel] = WallPixel(surface, wall_m, row, column).aspect_deg(lines);
  });
  return aspect_deg;
}

}  // namespace farlod
