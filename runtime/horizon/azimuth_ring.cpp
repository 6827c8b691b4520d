// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/azimuth_ring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "farlod/expects.hpp"
#include "horizon/lanes.hpp"

namespace farlod {
namespace {

std::int32_t steps_to(Point2d d) {
  const std::int32_t steps = steps_of(diamond_turns(all(static_cast<float>(d.x)), all(static_cast<float>(d.y))))[0];
  return steps < one_turn ? steps : 0;
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
  std::vector<std::int32_t> unordered;
  for (const Point2d d : directions) unordered.push_back(steps_to(d));
  std::iota(place_.begin(), place_.end(), 0U);
  std::stable_sort(place_.begin(), place_.end(), [&](std::uint32_t a, std::uint32_t b) { return unordered[a] < unordered[b]; });
  for (const std::uint32_t n : place_) {
    steps_.push_back(unordered[n]);
    turns_.push_back(static_cast<float>(unordered[n]) / static_cast<float>(one_turn));
    cosine_.push_back(static_cast<float>(directions[n].x));
    sine_.push_back(static_cast<float>(directions[n].y));
  }
  first_of_slot_ = first_of_parts(slots());
  first_of_sector_ = first_of_parts(sectors);
}

std::vector<std::uint32_t> AzimuthRing::first_of_parts(std::size_t count) const {
  std::vector<std::uint32_t> result;
  for (std::size_t part = 0; part < count; ++part) {
    const auto from = static_cast<std::int32_t>((static_cast<std::uint64_t>(part) * one_turn + count - 1) / count);
    result.push_back(static_cast<std::uint32_t>(std::lower_bound(steps_.begin(), steps_.end(), from) - steps_.begin()));
  }
  result.push_back(static_cast<std::uint32_t>(size()));
  return result;
}

}  // namespace farlod
