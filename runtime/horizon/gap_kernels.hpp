// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/receiver_packet.hpp"

/// What is seen in gaps: at an azimuth, each triangle hides the slopes between the ends of its section, and the sky is what none
/// of them hides. docs/concepts.md, "What is grounded, and what overhangs".
namespace farlod {

/// Sixteen gaps, each of a receiver at an azimuth, all within less than half a turn and in the order of their azimuths: from one
/// slope up to another, less the slopes between both ends of what is hidden in it. Lanes without a gap have `from` = `to`.
struct GapBlock {
  using Lanes = ReceiverPacket::Lanes;
  alignas(64) Lanes x, y, z, normal_x, normal_y, normal_z, cosine, sine;  ///< the receivers, cell frame, and their azimuths
  Lanes from, to, hidden_from, hidden_to;
  // What is found
  Lanes sky;       ///< open sky, as a share of the turn's at this azimuth
  Lanes is_split;  ///< 1 where more than one interval is open, else 0
};

/// Facets, and the boxes of their batches.
struct FacetsInBoxes {
  std::span<const OverhangFacets::Batch> batches;
  std::span<const OverhangFacets::Boxes> boxes;
};

/// SectorMinHorizon of edge_culling.hpp, for whoever keeps it.
using LowestOfSectors = std::array<float, std::bit_width(AzimuthSampling::sectors) * AzimuthSampling::sectors>;

struct GapKernels {
  /// A bit for each receiver that has sky in a gap, at each azimuth, in rows.
  void (*find_gaps)(const float* sky, std::size_t azimuth_count, std::uint16_t* receivers);
  /// The lowest slope of some horizons in each of the sectors of azimuths, as find_above reads them.
  void (*find_lowest)(std::span<const float* const> horizons, const AzimuthView& azimuths, LowestOfSectors& lowest);
  /// The facets that may hide a slope above some of these horizons, of packets whose receivers lie within these bounds: a bit for
  /// each lane of each batch, found[batch]. Bits of lanes without a facet mean nothing.
  void (*find_above)(const FacetsInBoxes& facets, const PacketBounds& bounds, const LowestOfSectors& lowest,
                     std::uint16_t* found);
  /// Where the facets of batches with bits lie about the centre of a box in the plan: its ring, from near to far, and therein its
  /// sector, less than `bins`.
  static constexpr std::size_t rings = 32, sectors_of_ring = 32, bins = rings * sectors_of_ring;
  void (*find_bins)(std::span<const OverhangFacets::Batch> facets, const CenteredBox& box, const std::uint16_t* found,
                    std::int32_t* bins_of_facets);
  /// Narrows gaps to what facets leave open: where nothing is left, `from` = `to`. `room` is for 32 floats of each facet, and of
  /// one more.
  void (*find_open)(const FacetsInBoxes& facets, bool is_solid, float* room, GapBlock& gaps);
};

}  // namespace farlod
