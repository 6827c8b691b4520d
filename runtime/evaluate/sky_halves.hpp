// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.hpp"
#include "farlod/angle.hpp"
#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "package/manifest.hpp"

namespace farlod {

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
