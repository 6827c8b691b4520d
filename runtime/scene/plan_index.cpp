// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/plan_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace farlod {
namespace {

constexpr std::size_t most_squares_along = 64;

}  // namespace

template <class Visit>
void PlanIndex::for_each_square(const Visit& visit) const {
  for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
    if (plan_area(triangles_[n]) == 0.0) continue;
    const PlanOutline o = outline_of(triangles_[n]);
    for (std::size_t row = row_of(o.south); row <= row_of(o.north); ++row)
      for (std::size_t column = column_of(o.west); column <= column_of(o.east); ++column) visit(row * edge_ + column, n);
  }
}

PlanIndex::PlanIndex(std::vector<PlanTriangle> triangles) : triangles_(std::move(triangles)) {
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
  PlanOutline all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                  std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const PlanTriangle& t : triangles_) {
    const PlanOutline o = outline_of(t);
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

void PlanIndex::find(float x, float y, std::vector<PlanCrossing>& crossings) const {
  if (triangles_.empty()) return;
  const std::size_t square = row_of(y) * edge_ + column_of(x);
  for (std::uint32_t k = first_of_[square]; k < first_of_[square + 1]; ++k) {
    const PlanTriangle& t = triangles_[numbers_[k]];
    if (covers(t, x, y)) crossings.push_back({numbers_[k], height_at(t, x, y)});
  }
}

}  // namespace farlod
