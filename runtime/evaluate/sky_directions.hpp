// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/frame.hpp"
#include "farlod/angle.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "package/manifest.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The directions in which a receiver looks, in the grid frame. They are fixed in the city frame, so that turning the grid
/// changes no receiver's directions.
class SkyDirections {
 public:
  /// Throws Cancelled when `stop` is asked for: millions of directions take a second.
  SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation, DirectionSet set = DirectionSet::partition,
                const std::stop_token& stop = {});

  /// Number of rays of the hemisphere, above the horizon or below it: the denominator of a view factor.
  [[nodiscard]] std::size_t ray_count() const { return local_.size(); }
  /// The directions of a receiver whose normal points straight up: all rays, all above the horizon.
  [[nodiscard]] std::span<const Point3d> facing_up() const { return facing_up_; }
  /// The directions of a receiver with this normal (length 1, grid frame): those of its rays that point above the horizon.
  [[nodiscard]] std::vector<Point3d> facing(const Point3d& normal) const;
  /// All rays around this normal, above the horizon or below it.
  [[nodiscard]] std::vector<Point3d> around(const Point3d& normal) const;
  /// Those of a receiver that point above the horizon.
  [[nodiscard]] std::vector<Point3d> facing_as(const Receiver& receiver) const {
    const Point3f& n = receiver.normal;
    return n == Point3f{0.0F, 0.0F, 1.0F} ? facing_up_ : facing(normalized(Point3d{n.x, n.y, n.z}));
  }

 private:
  std::vector<Point3d> local_;  ///< around the receiver's own axis
  std::vector<Point3d> facing_up_;
};

/// A direction of the grid frame in the plan, clockwise from true north, as a share of the turn: 0 to 1.
[[nodiscard]] double turn_of(const Point2d& direction_grid, const GridRotation& rotation, Angle convergence);

/// The halves of the sky whose middles are north, east, south and west, in this order.
class SkyHalves {
 public:
  static constexpr std::size_t count = 4;
  /// A sum for each receiver of a packet.
  using Sums = std::array<double, ReceiverPacket::lanes>;
  /// A bit for each half.
  using Bits = std::uint8_t;

  /// Each azimuth stands for an equal part of the turn around it.
  SkyHalves(const AzimuthSampling& azimuths, const package::Manifest& manifest);

  /// Twice the part of a sum that each half has, as UMEP counts them: the mean of opposite halves is the whole sum. `terms` are
  /// those of the azimuths.
  [[nodiscard]] std::array<Sums, count> sums(std::span<const PacketHorizon::Row> terms) const;

  /// Which halves a direction lies in: two of them, one of each opposite pair.
  [[nodiscard]] Bits of(const Point3d& direction_grid) const;

 private:
  GridRotation rotation_;
  Angle convergence_;
  std::array<std::vector<float>, count> shares_;  ///< of the part of the turn around each azimuth
};

}  // namespace farlod
