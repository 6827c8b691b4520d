// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/azimuth_sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// The same operations as pseudo_angle (lanes.hpp), for one direction.
float pseudo_angle_turns(Point2d d) {
  const auto x = static_cast<float>(d.x), y = static_cast<float>(d.y);
  const float sum = std::abs(x) + std::abs(y), quarter = 0.25F * y / (sum > 0.0F ? sum : 1.0F);
  const float turns = x < 0.0F ? 0.5F - quarter : y < 0.0F ? 1.0F + quarter : quarter;
  return turns < 1.0F ? turns : 0.0F;
}

std::vector<Point2d> unit_vectors_of(std::span<const Point3d> directions) {
  std::vector<Point2d> unit;
  for (const Point3d& d : directions) {
    const double across = std::hypot(d.x, d.y);
    unit.push_back(across > 0.0 ? (1.0 / across) * horizontal(d) : Point2d{1.0, 0.0});
  }
  return unit;
}

}  // namespace

AzimuthSampling AzimuthSampling::even(std::size_t count, const GridRotation& rotation) {
  std::vector<Point2d> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    directions.push_back(rotation.grid_from_city(Point2d{std::cos(azimuth), std::sin(azimuth)}));
  }
  return AzimuthSampling(std::span<const Point2d>(directions));
}

AzimuthSampling::AzimuthSampling(std::span<const Point3d> directions)
    : AzimuthSampling(std::span<const Point2d>(unit_vectors_of(directions))) {}

AzimuthSampling::AzimuthSampling(std::span<const Point2d> unit_vectors) : order_(unit_vectors.size()) {
  FARLOD_EXPECTS(!unit_vectors.empty());
  // Sort by the pseudo-angle
  std::vector<float> unordered;
  for (const Point2d u : unit_vectors) unordered.push_back(pseudo_angle_turns(u));
  std::iota(order_.begin(), order_.end(), 0U);
  std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return unordered[a] < unordered[b]; });
  for (const std::uint32_t n : order_) {
    turns_.push_back(unordered[n]);
    cosine_.push_back(static_cast<float>(unit_vectors[n].x));
    sine_.push_back(static_cast<float>(unit_vectors[n].y));
  }
  // Index the sectors of one turn, and the slots of three
  first_of_sector_ = first_of_parts(sectors);
  const std::vector<std::uint32_t> one_turn = first_of_parts(std::bit_ceil(4 * size()));
  for (std::uint32_t turn = 0; turn < 3; ++turn) {
    if (turn > 0) first_of_slot_.pop_back();
    for (const std::uint32_t first : one_turn) first_of_slot_.push_back(first + turn * static_cast<std::uint32_t>(size()));
  }
}

AzimuthSampling::Pair AzimuthSampling::around(Point2d direction) const {
  const auto after = static_cast<std::uint32_t>(std::ranges::upper_bound(turns_, pseudo_angle_turns(direction)) - turns_.begin());
  const auto count = static_cast<std::uint32_t>(size());
  return {(after == 0 ? count : after) - 1, after == count ? 0 : after};
}

std::vector<std::uint32_t> AzimuthSampling::first_of_parts(std::size_t count) const {
  std::vector<std::uint32_t> result;
  for (std::size_t part = 0; part < count; ++part) {
    const float from = static_cast<float>(part) / static_cast<float>(count);
    result.push_back(static_cast<std::uint32_t>(std::lower_bound(turns_.begin(), turns_.end(), from) - turns_.begin()));
  }
  result.push_back(static_cast<std::uint32_t>(size()));
  return result;
}

DirectionSampling::DirectionSampling(std::span<const Point3d> directions) : azimuths_(directions) {
  for (const std::uint32_t n : azimuths_.order()) {
    const Point3d& d = directions[n];
    directions_.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
    slopes_.push_back(static_cast<float>(d.z / std::hypot(d.x, d.y)));
  }
}

}  // namespace farlod
