// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "base/grid.hpp"
#include "canopy/canopy_field.hpp"
#include "canopy/crown_kernels.hpp"
#include "canopy/dimmed_sky.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

/// The packets of the receivers of a cell, where those at the centres of pixels are in groups of squares of pixels, whose rows
/// are marched at once.
[[nodiscard]] PacketOrder order_on_pixels(const CanopyLattice& lattice, const Grid& grid, Cell cell,
                                          std::span<const Receiver> receivers, const std::stop_token& stop);

/// The sky behind the crowns of a canopy raster, by the rule `once`, for receivers of one cell at the centres of its pixels that
/// look straight up: rays march over the pixels, each of which is a prism. docs/concepts.md, "Canopies of rasters". Of one
/// thread.
///   (1) the answers of a receiver depend on its own profile and place, and on the canopy
///   (2) at each azimuth, what is behind crowns differs from that of the same prisms one by one by at most half of
///       least_sky_behind of the sky, but for rounding
class CanopyOnPixels {
 public:
  /// The answers of a group of packets, each of them only for the lanes that are answered.
  struct Answers {
    std::span<PacketHorizon::Lanes> behind;  ///< of each packet: the sky that is free of solid things and behind any crown
    std::span<PacketHorizon::Lanes> hidden;  ///< solid things behind crowns
    std::span<PacketHorizon::Row> behind_of_azimuths, hidden_of_azimuths;  ///< packet by packet, or empty
    /// The slopes behind crowns of each packet, with 1 as the share that is lost. Or empty
    std::span<DimmedSky> dimmed = {};
  };

  /// The city must outlive it.
  CanopyOnPixels(const CanopyCity& city, Cell cell, const CanopyMarchKernels& kernels = *crown_kernels().march)
      : city_(city), cell_(cell), kernels_(kernels) {}
  [[nodiscard]] Foliage foliage() const { return city_.lattice.foliage(); }

  /// Returns a bit for each lane of each packet that is answered: receivers beside the centres of pixels, such that look
  /// elsewhere, and those with a gap below an overhang are not. `answered` has a place for each packet. What is hidden is
  /// answered if the field knows what is solid.
  void evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets, const Answers& answers,
                std::span<std::uint32_t> answered);

 private:
  struct OnPixel {
    CanopyLattice::Place place;
    std::uint32_t packet, lane;
  };
  /// Receivers above some of sixteen pixels, and what is marched of them.
  struct Row {
    std::span<const OnPixel> receivers;
    std::vector<PacketHorizon::Row> sky_from, sky, behind, hidden;
    PacketHorizon::Lanes sum_behind, sum_hidden;
    DimmedSky dimmed;  ///< its lanes are pixels
  };
  void find_on_pixels(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets);
  /// Takes as many receivers as are above sixteen pixels in a row, from one on. Returns the number of the next.
  std::size_t add_row(std::size_t first, std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                      const Answers& answers);
  /// Takes the profiles over from packets.
  void make_ready(Row& row, CanopyRow& marched, std::span<const SkyProfile> profiles, const Answers& answers) const;
  void march_rows(const Answers& answers);
  void store(const Row& row, std::int32_t first_column, const Answers& answers) const;

  const CanopyCity& city_;
  Cell cell_;
  const CanopyMarchKernels& kernels_;
  // Working memory
  std::vector<OnPixel> found_;
  std::vector<Row> rows_;
  std::vector<CanopyRow> marched_;
  std::vector<KeepDimmed> keepers_;  ///< of the rows
  std::vector<PacketHorizon::Row> room_;
};

}  // namespace farlod
