// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/wedge_kernels.hpp"

/// What is seen in gaps: at an azimuth, each triangle hides the slopes between the ends of its section, and the sky is what none
/// of them hides. docs/concepts.md, "What is grounded, and what overhangs".
namespace farlod {

/// Sixteen receivers, cell frame, and an azimuth of each: all within less than half a turn, and in their order.
struct EyeBlock {
  using Lanes = ReceiverPacket::Lanes;
  alignas(64) Lanes x, y, z, normal_x, normal_y, normal_z, cosine, sine;

  void set(std::size_t n, const ReceiverPacket& r, std::size_t lane, const AzimuthSampling& azimuths, std::size_t azimuth) {
    x[n] = r.x[lane];
    y[n] = r.y[lane];
    z[n] = r.z[lane];
    normal_x[n] = r.normal_x[lane];
    normal_y[n] = r.normal_y[lane];
    normal_z[n] = r.normal_z[lane];
    cosine[n] = azimuths.cosine()[azimuth];
    sine[n] = azimuths.sine()[azimuth];
  }
};

/// Sixteen gaps, each of a receiver at an azimuth: from one slope up to another, less the slopes between both ends of what is
/// hidden in it. Lanes without a gap have `from` = `to`.
struct GapBlock {
  using Lanes = ReceiverPacket::Lanes;
  EyeBlock eyes;
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

/// The gaps of a block lie within such a part of the turn: fewer facets are met in narrow wedges.
inline constexpr std::size_t blocks_of_turn = 12;
/// How many of the first gaps, in the order of their azimuths, go into a block.
template <class Gap>
[[nodiscard]] std::size_t size_of_block(std::span<const Gap> gaps, std::size_t azimuths) {
  const std::size_t end = gaps.front().azimuth + azimuths / blocks_of_turn;
  std::size_t size = std::min(packet_lanes, gaps.size());
  while (gaps[size - 1].azimuth > end) --size;
  return size;
}

/// SectorMinHorizon of edge_culling.hpp, for whoever keeps it.
using LowestOfSectors = std::array<float, std::bit_width(AzimuthSampling::sectors) * AzimuthSampling::sectors>;

struct GapKernels {
  /// A bit for each receiver that has sky in a gap, at each azimuth, in rows.
  void (*find_gaps)(const float* sky, std::size_t azimuth_count, std::uint16_t* receivers);
  /// The lowest slope of some horizons in each of the sectors of azimuths, as find_above reads them: at the azimuths there, or
  /// also at those beside.
  void (*find_lowest)(std::span<const float* const> horizons, const AzimuthView& azimuths, RaisingAt where,
                      LowestOfSectors& lowest);
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

/// Sixteen gaps between two azimuths each, the first of which are those of the eyes: WedgeGaps::Gap and what is found of it,
/// WedgeGaps::Sky.
struct WedgeGapBlock {
  using Lanes = ReceiverPacket::Lanes;
  EyeBlock eyes;
  Lanes from, to, top, lid, below;
  Lanes open, hidden, most;
};

struct WedgeGapKernels {
  /// A facet hides no more than the slopes between its lowest and its highest place in a wedge, and at least those between the
  /// higher one of its lower ends at both azimuths and the lower one of its upper ends. `room` is for 64 floats of each lane of
  /// each batch, and of one more. docs/concepts.md, "Bounds of a sky view factor".
  void (*find_certain)(const FacetsInBoxes& facets, const WedgeShape& shape, bool is_solid, float* room, WedgeGapBlock& gaps);
};

}  // namespace farlod
