// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/plan_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace farlod {
namespace {

constexpr std::size_t most_squares_along = 64;

struct Outline {
  float west, east, south, north;
};

Outline outline_of(const PlanIndex::Corners& t) {
  return {std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y}),
          std::max({t[0].y, t[1].y, t[2].y})};
}

/// Which side of the line from a to b a place is on: left is positive. The ends are taken in one order, whichever way the edge
/// runs, so that both triangles beside it say the same.
double side_of(const Point3f& a, const Point3f& b, float x, float y) {
  const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  const Point3f &from = turned ? b : a, &to = turned ? a : b;
  const double side = (double{to.x} - from.x) * (double{y} - from.y) - (double{to.y} - from.y) * (double{x} - from.x);
  return turned ? -side : side;
}

bool covers(const PlanIndex::Corners& t, float x, float y) {
  const double ab = side_of(t[0], t[1], x, y), bc = side_of(t[1], t[2], x, y), ca = side_of(t[2], t[0], x, y);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// Twice the area in the plan.
double plan_area(const PlanIndex::Corners& t) { return side_of(t[0], t[1], t[2].x, t[2].y); }

float height_at(const PlanIndex::Corners& t, float x, float y) {
  const double ux = double{t[1].x} - t[0].x, uy = double{t[1].y} - t[0].y, uz = double{t[1].z} - t[0].z;
  const double vx = double{t[2].x} - t[0].x, vy = double{t[2].y} - t[0].y, vz = double{t[2].z} - t[0].z;
  const double px = double{x} - t[0].x, py = double{y} - t[0].y, area = ux * vy - uy * vx;
  const double z = (uz * (px * vy - py * vx) + vz * (ux * py - uy * px)) / area;
  // Beyond its corners no triangle is higher, whatever rounding says
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  return std::clamp(static_cast<float>(t[0].z + z), low, high);
}

}  // namespace

template <class Visit>
void PlanIndex::for_each_square(const Visit& visit) const {
  for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
    if (plan_area(triangles_[n]) == 0.0) continue;
    const Outline o = outline_of(triangles_[n]);
    for (std::size_t row = row_of(o.south); row <= row_of(o.north); ++row)
      for (std::size_t column = column_of(o.west); column <= column_of(o.east); ++column) visit(row * edge_ + column, n);
  }
}

PlanIndex::PlanIndex(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  lay_out_squares();
  // Count the triangles of each square, sum up where each square begins, then place the numbers
  first_of_.assign(edge_ * edge_ + 1, 0);
  for_each_square([this](std::size_t square, std::uint32_t) { ++first_of_[square + 1]; });
  for (std::size_t square = 1; square < first_of_.size(); ++square) first_of_[square] += first_of_[square - 1];
  numbers_.resize(first_of_.back());
  std::vector<std::uint32_t> next(first_of_.begin(), first_of_.end() - 1);
  for_each_square([&](std::size_t square, std::uint32_t n) { numbers_[next[square]++] = n; });
}

void PlanIndex::lay_out_squares() {
  Outline all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
              std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const Corners& t : triangles_) {
    const Outline o = outline_of(t);
    all = {std::min(all.west, o.west), std::max(all.east, o.east), std::min(all.south, o.south), std::max(all.north, o.north)};
  }
  low_ = {all.west, all.south, 0.0F};
  // As many squares as triangles, so that each holds few
  edge_ =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles_.size()))), 1, most_squares_along);
  const auto per_metre = [this](float length) { return length > 0.0F ? static_cast<float>(edge_) / length : 0.0F; };
  per_x_ = per_metre(all.east - all.west);
  per_y_ = per_metre(all.north - all.south);
}

std::size_t PlanIndex::column_of(float x) const {
  const float place = std::clamp((x - low_.x) * per_x_, 0.0F, static_cast<float>(edge_ - 1));
  return static_cast<std::size_t>(place);
}

std::size_t PlanIndex::row_of(float y) const {
  const float place = std::clamp((y - low_.y) * per_y_, 0.0F, static_cast<float>(edge_ - 1));
  return static_cast<std::size_t>(place);
}

void PlanIndex::find(float x, float y, std::vector<Crossing>& crossings) const {
  if (triangles_.empty()) return;
  const std::size_t square = row_of(y) * edge_ + column_of(x);
  for (std::uint32_t k = first_of_[square]; k < first_of_[square + 1]; ++k) {
    const Corners& t = triangles_[numbers_[k]];
    if (covers(t, x, y)) crossings.push_back({numbers_[k], height_at(t, x, y)});
  }
}

}  // namespace farlod
