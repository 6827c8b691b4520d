// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/skyline_edges.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// What does not stand solidly, around a cell: bridges, eaves, open shells. It may be seen under, so that rays must meet it; but
/// only rays that pass below its outline can.
class HangingCity {
 public:
  using TriangleCorners = std::array<Point3f, 3>;

  explicit HangingCity(std::span<const TriangleCorners> triangles);

  [[nodiscard]] bool empty() const { return edges_.empty(); }
  /// Its triangles, for rays in the cell frame.
  [[nodiscard]] Occluder scene() const;
  /// Raises the horizons to the outlines: from no receiver does anything that hangs show above, unless it is right overhead.
  void raise(const ReceiverPacket& receivers, PacketHorizon& outlines) const { outlines.raise(edges_, receivers); }
  /// A bit for each receiver that has something overhead.
  [[nodiscard]] std::uint32_t covered(const ReceiverPacket& receivers) const;

 private:
  std::vector<TriangleCorners> triangles_;
  SkylineEdges edges_;  ///< each once, of all triangles
};

}  // namespace farlod
