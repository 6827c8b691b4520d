// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/canopy_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

namespace farlod {
namespace {

/// Fewer prisms alike are no raster.
constexpr std::size_t least_pixels = 16;

/// What pixels of one raster have in common.
using RasterKey = std::tuple<std::uint16_t, float, Foliage>;
RasterKey key_of(const Crown& crown) { return {crown.turn, crown.half_width_m, crown.foliage}; }

/// Bits of a number with a gap before each of them.
std::uint64_t spread(std::uint32_t number) {
  std::uint64_t bits = number;
  for (const auto& [shift, mask] :
       {std::pair{16, 0x0000FFFF0000FFFFULL}, std::pair{8, 0x00FF00FF00FF00FFULL}, std::pair{4, 0x0F0F0F0F0F0F0F0FULL},
        std::pair{2, 0x3333333333333333ULL}, std::pair{1, 0x5555555555555555ULL}})
    bits = (bits | (bits << shift)) & mask;
  return bits;
}

/// The columns and rows of pixels, counted from where the frame begins. Half of the numbers are for those before it. They are the
/// same whichever pixel tells where in its frame the raster lies.
class PixelPlaces {
 public:
  explicit PixelPlaces(const Crown& any)
      : pixel_m_(2.0 * any.half_width_m),
        cosine_(std::cos(any.turn_rad())),
        sine_(std::sin(any.turn_rad())),
        phase_x_(phase_of(along_x(any))),
        phase_y_(phase_of(along_y(any))) {}

  [[nodiscard]] std::uint64_t of(const Crown& pixel) const {
    return spread(number(along_x(pixel) - phase_x_)) | (spread(number(along_y(pixel) - phase_y_)) << 1U);
  }

 private:
  // In pixels
  [[nodiscard]] double along_x(const Crown& c) const { return (c.x_m * cosine_ + c.y_m * sine_) / pixel_m_; }
  [[nodiscard]] double along_y(const Crown& c) const { return (c.y_m * cosine_ - c.x_m * sine_) / pixel_m_; }
  /// From −.3 to .7: rasters begin at whole or half pixels, and floats should not decide at which end of an interval these are.
  static double phase_of(double along) { return along - std::floor(along + 0.3); }
  static std::uint32_t number(double along) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(along))) + 0x80000000U;
  }

  double pixel_m_, cosine_, sine_, phase_x_, phase_y_;
};

/// How much the outlines count in the heights of a square, beside the means of its quarters: with outlines alone, measured on a
/// real canopy, crowns take too much of the sky; with means alone, too little.
constexpr double outline_share = 0.5;

/// What a row or a column of quarters shows to one who looks along it: from their lowest bottom to their highest top.
struct Outline {
  float bottom_m = std::numeric_limits<float>::infinity(), top_m = -std::numeric_limits<float>::infinity();

  void add(const Crown& crown) {
    bottom_m = std::min(bottom_m, crown.bottom_m);
    top_m = std::max(top_m, crown.top_m);
  }
  [[nodiscard]] bool is_none() const { return top_m < bottom_m; }
};

/// The quarters of a square, as one prism: in their middle, as large as all of them, with heights of the outlines of both rows
/// and both columns, and of the quarters themselves. The two lowest bits of a quarter's place are its column and its row.
template <class Squares>
Crown merged(const Squares& quarters) {
  std::array<Outline, 4> outlines;
  double area = 0.0, x = 0.0, y = 0.0, mean_bottom = 0.0, mean_top = 0.0;
  for (const auto& quarter : quarters) {
    const Crown& c = quarter.crown;
    const double a = static_cast<double>(c.half_width_m) * c.half_width_m;
    area += a, x += a * c.x_m, y += a * c.y_m, mean_bottom += a * c.bottom_m, mean_top += a * c.top_m;
    outlines[quarter.place & 1U].add(c);
    outlines[2U + (quarter.place >> 1U & 1U)].add(c);
  }
  const auto seen = std::ranges::count_if(outlines, [](const Outline& o) { return !o.is_none(); });
  double bottom = 0.0, top = 0.0;
  for (const Outline& o : outlines)
    if (!o.is_none()) bottom += static_cast<double>(o.bottom_m), top += static_cast<double>(o.top_m);
  Crown one = quarters.front().crown;
  one.x_m = static_cast<float>(x / area), one.y_m = static_cast<float>(y / area);
  one.bottom_m =
      static_cast<float>(outline_share * bottom / static_cast<double>(seen) + (1.0 - outline_share) * mean_bottom / area);
  one.top_m = static_cast<float>(outline_share * top / static_cast<double>(seen) + (1.0 - outline_share) * mean_top / area);
  one.half_width_m = static_cast<float>(std::sqrt(area));
  return one;
}

double distance_m(const Crown& crown, const Box2d& box) {
  const double x = std::max({0.0, box.low.x - crown.x_m, crown.x_m - box.high.x}),
               y = std::max({0.0, box.low.y - crown.y_m, crown.y_m - box.high.y});
  return std::hypot(x, y);
}

}  // namespace

CanopyLevels::CanopyLevels(const std::vector<Crown>& crowns, double largest_square_m) {
  std::map<RasterKey, std::vector<Square>> pixels;
  std::map<RasterKey, PixelPlaces> places;
  for (const Crown& crown : crowns) {
    if (crown.shape != CrownShape::prism) {
      single_.push_back(crown);
      continue;
    }
    const PixelPlaces& of_raster = places.try_emplace(key_of(crown), crown).first->second;
    pixels[key_of(crown)].push_back({of_raster.of(crown), crown, 0, 0});
  }
  for (auto& [key, squares] : pixels) {
    std::stable_sort(squares.begin(), squares.end(), [](const Square& a, const Square& b) { return a.place < b.place; });
    if (squares.size() < least_pixels) {
      for (const Square& square : squares) single_.push_back(square.crown);
      continue;
    }
    Raster raster{2.0 * squares.front().crown.half_width_m, {std::move(squares)}};
    for (double edge_m = 2.0 * raster.pixel_m; edge_m <= largest_square_m; edge_m *= 2.0)
      raster.levels.push_back(squares_over(raster.levels.back()));
    rasters_.push_back(std::move(raster));
  }
}

std::vector<CanopyLevels::Square> CanopyLevels::squares_over(const std::vector<Square>& quarters) {
  std::vector<Square> squares;
  for (std::size_t first = 0, end = 0; first < quarters.size(); first = end) {
    const std::uint64_t place = quarters[first].place >> 2U;
    while (end < quarters.size() && quarters[end].place >> 2U == place) ++end;
    const auto some = std::span(quarters).subspan(first, end - first);
    squares.push_back({place, some.size() == 1 ? some.front().crown : merged(some), first, end});
  }
  return squares;
}

void CanopyLevels::add_seen(const Raster& raster, std::size_t level, const Square& square, const Box2d& places,
                            const PixelMerging& merging, std::vector<Crown>& seen) {
  const double edge_m = raster.pixel_m * static_cast<double>(std::uint64_t{1} << level);
  const double to_border_m = 0.5 * std::numbers::sqrt2 * edge_m;
  if (level == 0 || distance_m(square.crown, places) - to_border_m >= merging.edges_away * edge_m)
    return seen.push_back(square.crown);
  for (std::size_t n = square.first; n < square.end; ++n)
    add_seen(raster, level - 1, raster.levels[level - 1][n], places, merging, seen);
}

std::vector<Crown> CanopyLevels::seen_from(const Box2d& places, const PixelMerging& merging) const {
  std::vector<Crown> seen = single_;
  for (const Raster& raster : rasters_)
    for (const Square& square : raster.levels.back()) add_seen(raster, raster.levels.size() - 1, square, places, merging, seen);
  return seen;
}

}  // namespace farlod
