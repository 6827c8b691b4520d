// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/gap_kernels.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {

/// The facets that may rise above the horizons of some packets, from near to far, and neighbors together.
class FacetsInSight {
 public:
  /// The sampling must outlive it.
  explicit FacetsInSight(const AzimuthSampling& azimuths, RaisingAt where = RaisingAt::azimuths)
      : azimuths_(azimuths), where_(where) {}

  /// Begins with packets that have these horizons.
  void begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> horizons);
  /// Those among some facets, which must be the same until it begins again.
  [[nodiscard]] const OverhangFacets& among(const OverhangFacets& facets);

 private:
  void sort(const OverhangFacets& facets);

  const AzimuthSampling& azimuths_;
  RaisingAt where_;
  PacketBounds bounds_;
  LowestOfSectors lowest_{};
  bool is_sorted_ = false;
  OverhangFacets sorted_;
  // Working memory, kept from call to call
  std::vector<std::int32_t> bins_;
  std::vector<std::uint32_t> places_, order_;
  std::vector<std::uint16_t> found_;
};

}  // namespace farlod
