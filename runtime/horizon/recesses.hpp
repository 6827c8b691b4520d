// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"

namespace farlod {

/// Receivers in recesses, such as windows set back. A border over a recess is grounded for all eyes but those in it: these see
/// the borders around from below their facets, and what is near by rays alone. docs/concepts.md, "What is grounded, and what
/// overhangs".
class Recesses {
 public:
  /// All must outlive it.
  Recesses(const AzimuthSampling& azimuths, const CellSilhouettes& silhouettes)
      : silhouettes_(silhouettes),
        drawn_(azimuths, PacketHorizon::Edges::numbered),
        by_others_(azimuths, PacketHorizon::Edges::numbered) {}

  /// What is overhead of receivers, of which these bits are below an overhang.
  [[nodiscard]] Overhead overhead_of(const ReceiverPacket& receivers, std::uint32_t below) const;

  /// Draws the grounded horizons of the receivers in recesses again, each without the borders that may lie over its own recess,
  /// above those that `begin(packet, horizon)` makes of level ones.
  template <class Begin>
  void draw_again(const ReceiverPacket& receivers, const Overhead& overhead, const Begin& begin, PacketHorizon& grounded) {
    if (overhead.in_recess == 0) return;
    find_own_borders(receivers, overhead.in_recess);
    drawn_.clear();
    begin(receivers, drawn_);
    draw_others(receivers, overhead.in_recess, grounded);
  }

 private:
  /// A border, and a bit for each receiver over whose recess it may lie.
  struct OwnBorder {
    std::size_t number;
    std::uint32_t receivers;
  };
  void find_own_borders(const ReceiverPacket& receivers, std::uint32_t in_recess);
  void draw_others(const ReceiverPacket& receivers, std::uint32_t in_recess, PacketHorizon& grounded);
  void choose(std::size_t number, bool is_chosen);

  const CellSilhouettes& silhouettes_;
  // Working memory
  PacketHorizon drawn_, by_others_;
  std::vector<OwnBorder> own_;
  SilhouetteEdges edges_;
  std::vector<std::uint16_t> chosen_;  ///< a bit for each lane of each batch of the grounded edges
};

}  // namespace farlod
