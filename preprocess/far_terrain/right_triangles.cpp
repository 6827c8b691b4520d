// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "far_terrain/right_triangles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/expects.hpp"

namespace farlod::far_terrain {

namespace {

bool can_be_halved(std::uint32_t side, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t along = side + 1;
  return (a % along + b % along) % 2 == 0 && (a / along + b / along) % 2 == 0;
}

}  // namespace

RightTriangles::RightTriangles(std::uint32_t side) : side_(side), excess_(std::size_t{side + 1} * (side + 1)) {
  FARLOD_EXPECTS(std::has_single_bit(side) && side >= 2 && side <= 256);
  const std::uint32_t last = (side + 1) * (side + 1) - 1;
  halvable_ = {{0, last, side, false}, {last, 0, last - side, false}};
  for (std::size_t n = 0; n < halvable_.size(); ++n) {
    const auto [a, b, c, unused] = halvable_[n];
    const std::uint32_t middle = (a + b) / 2;
    if (!can_be_halved(side, a, c)) continue;
    halvable_[n].has_halvable_halves = true;
    halvable_.push_back({c, a, middle, false});
    halvable_.push_back({b, c, middle, false});
  }
}

/// From the smallest triangles up, so that each knows what is within.
void RightTriangles::measure(const HeightsOfSquare& heights) {
  std::ranges::fill(excess_, 0.0F);
  for (std::size_t n = halvable_.size(); n > 0; --n) {
    const auto [a, b, c, has_halvable_halves] = halvable_[n - 1];
    const std::uint32_t middle = (a + b) / 2;
    const float off_m = std::abs(0.5F * (heights.height_m[a] + heights.height_m[b]) - heights.height_m[middle]);
    const bool has_all = !std::isnan(off_m), has_none = std::isnan(heights.height_m[a]) && std::isnan(heights.height_m[b]) &&
                                                        std::isnan(heights.height_m[middle]);
    float& excess = excess_[middle];
    if (has_all) excess = std::max(excess, off_m / heights.tolerance_m[middle]);
    if (!has_all && !has_none) excess = std::numeric_limits<float>::infinity();
    if (has_halvable_halves) excess = std::max({excess, excess_[(a + c) / 2], excess_[(b + c) / 2]});
  }
}

void RightTriangles::divide(const HeightsOfSquare& heights, const Triangle& t, std::vector<Triangle>& triangles) const {
  const std::uint32_t middle = (t.a + t.b) / 2;
  if (can_be_halved(side_, t.a, t.b) && excess_[middle] > 1.0F) {
    divide(heights, {t.c, t.a, middle}, triangles);
    divide(heights, {t.b, t.c, middle}, triangles);
    return;
  }
  for (const std::uint32_t corner : {t.a, t.b, t.c})
    if (std::isnan(heights.height_m[corner])) return;
  triangles.push_back(t);
}

std::vector<Triangle> RightTriangles::triangulate(const HeightsOfSquare& heights) {
  FARLOD_EXPECTS(heights.height_m.size() == excess_.size() && heights.tolerance_m.size() == excess_.size());
  measure(heights);
  std::vector<Triangle> triangles;
  for (const Halvable& half : {halvable_[0], halvable_[1]}) divide(heights, {half.a, half.b, half.right_angle}, triangles);
  return triangles;
}

}  // namespace farlod::far_terrain
