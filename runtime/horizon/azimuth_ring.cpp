// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/azimuth_ring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "farlod/expects.hpp"
#include "horizon/lanes.hpp"

namespace farlod {
namespace {

float turns_to(Point2d d) {
  const float turns = pseudo_angle(broadcast(static_cast<float>(d.x)), broadcast(static_cast<float>(d.y)))[0];
  return turns < 1.0F ? turns : 0.0F;
}

}  // namespace

AzimuthRing AzimuthRing::even(std::size_t count, const GridRotation& rotation) {
  std::vector<Point2d> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    directions.push_back(rotation.grid_from_city(Point2d{std::cos(azimuth), std::sin(azimuth)}));
  }
  return AzimuthRing(directions);
}

AzimuthRing AzimuthRing::of(std::span<const Point3d> directions) {
  std::vector<Point2d> unit;
  for (const Point3d& d : directions) {
    const double across = std::hypot(d.x, d.y);
    unit.push_back(across > 0.0 ? (1.0 / across) * horizontal(d) : Point2d{1.0, 0.0});
  }
  return AzimuthRing(unit);
}

AzimuthRing::AzimuthRing(std::span<const Point2d> directions) : place_(directions.size()) {
  FARLOD_EXPECTS(!directions.empty());
  std::vector<float> unordered;
  for (const Point2d d : directions) unordered.push_back(turns_to(d));
  std::iota(place_.begin(), place_.end(), 0U);
  std::stable_sort(place_.begin(), place_.end(), [&](std::uint32_t a, std::uint32_t b) { return unordered[a] < unordered[b]; });
  for (const std::uint32_t n : place_) {
    turns_.push_back(unordered[n]);
    cosine_.push_back(static_cast<float>(directions[n].x));
    sine_.push_back(static_cast<float>(directions[n].y));
  }
  first_of_sector_ = first_of_parts(sectors);
  const std::vector<std::uint32_t> one_turn = first_of_parts(std::bit_ceil(4 * size()));
  for (std::uint32_t turn = 0; turn < 3; ++turn) {
    if (turn > 0) first_of_slot_.pop_back();
    for (const std::uint32_t first : one_turn) first_of_slot_.push_back(first + turn * static_cast<std::uint32_t>(size()));
  }
}

std::vector<std::uint32_t> AzimuthRing::first_of_parts(std::size_t count) const {
  std::vector<std::uint32_t> result;
  for (std::size_t part = 0; part < count; ++part) {
    const float from = static_cast<float>(part) / static_cast<float>(count);
    result.push_back(static_cast<std::uint32_t>(std::lower_bound(turns_.begin(), turns_.end(), from) - turns_.begin()));
  }
  result.push_back(static_cast<std::uint32_t>(size()));
  return result;
}

}  // namespace farlod
