// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_directions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cancellation.hpp"
#include "base/expects.hpp"

namespace farlod {
namespace {

/// n points on the disk or the hemisphere, each with the same share of the sky around it: ring by ring by the golden angle.
std::vector<Point3d> fibonacci_directions(SkyWeight weight, std::size_t n, const std::stop_token& stop) {
  constexpr double golden_turns = 2.0 - std::numbers::phi;
  std::vector<Point3d> result;
  for (std::size_t i = 0; i < n; ++i) {
    throw_if_cancelled(stop);
    const double turns = static_cast<double>(i) * golden_turns;
    const double share_above = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    result.push_back(sky_direction(weight, share_above, 2.0 * std::numbers::pi * (turns - std::floor(turns))));
  }
  return result;
}

constexpr std::array<double, SkyHalves::count> middles{0.0, 0.25, 0.5, 0.75};  // north, east, south, west

/// The share of [from, to] that lies in [low, high], on a turn of 1; neither is longer than half a turn.
double share_within(double from, double to, double low, double high) {
  double within = 0.0;
  for (const double turn : {-1.0, 0.0, 1.0}) within += std::max(0.0, std::min(to + turn, high) - std::max(from + turn, low));
  return std::min(1.0, within / (to - from));
}

}  // namespace

SkyDirections::SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation, DirectionSet set,
                             const std::stop_token& stop)
    : local_(set == DirectionSet::partition ? SkyPartition(weight, ray_count).directions(stop)
                                            : fibonacci_directions(weight, ray_count, stop)) {
  facing_up_.reserve(local_.size());
  for (const Point3d& d : local_) facing_up_.push_back(rotation.grid_from_city(d));
}

std::vector<Point3d> SkyDirections::around(const Point3d& normal) const {
  // The receiver's own axes: one along the contour line, one up the slope
  const Point3d contour = normalized(cross(Point3d{0.0, 0.0, 1.0}, normal));
  std::vector<Point3d> result = facing_up_;
  if (contour == Point3d{}) {
    if (normal.z < 0.0)
      for (Point3d& d : result) d.z = -d.z;
    return result;
  }
  const Point3d upslope = cross(normal, contour);
  std::ranges::transform(local_, result.begin(), [&](const Point3d& d) { return d.x * contour + d.y * upslope + d.z * normal; });
  return result;
}

std::vector<Point3d> SkyDirections::facing(const Point3d& normal) const {
  std::vector<Point3d> result = around(normal);
  std::erase_if(result, [](const Point3d& d) { return d.z <= 0.0; });
  return result;
}

double turn_of(const Point2d& direction_grid, const GridRotation& rotation, Angle convergence) {
  // true azimuth = grid azimuth + convergence
  const double turn = (azimuth_of(rotation.city_from_grid(direction_grid)) + convergence).radians() / (2.0 * std::numbers::pi);
  return turn - std::floor(turn);
}

SkyHalves::SkyHalves(const AzimuthSampling& azimuths, const package::Manifest& manifest)
    : rotation_(manifest.grid.rotation), convergence_(manifest.convergence) {
  const double half_part = 0.5 / static_cast<double>(azimuths.size());
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    const double turn = turn_of({azimuths.cosine()[k], azimuths.sine()[k]}, rotation_, convergence_);
    for (std::size_t h = 0; h < count; ++h)
      shares_[h].push_back(
          static_cast<float>(share_within(turn - half_part, turn + half_part, middles[h] - 0.25, middles[h] + 0.25)));
  }
}

std::array<SkyHalves::Sums, SkyHalves::count> SkyHalves::sums(std::span<const PacketHorizon::Row> terms) const {
  FARLOD_EXPECTS(terms.size() == shares_.front().size());
  std::array<Sums, count> sums{};
  for (std::size_t h = 0; h < count; ++h)
    for (std::size_t k = 0; k < terms.size(); ++k)
      for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
        sums[h][l] += 2.0 * static_cast<double>(shares_[h][k]) * static_cast<double>(terms[k][l]);
  return sums;
}

SkyHalves::Bits SkyHalves::of(const Point3d& direction_grid) const {
  const double turn = turn_of({direction_grid.x, direction_grid.y}, rotation_, convergence_);
  Bits bits = 0;
  for (std::size_t h = 0; h < count; ++h) {
    // The half begins a quarter before its middle, and ends before the place where the opposite half begins
    const double from_begin = turn - middles[h] + 0.25;
    if (from_begin - std::floor(from_begin) < 0.5) bits |= static_cast<Bits>(1U << h);
  }
  return bits;
}

}  // namespace farlod
