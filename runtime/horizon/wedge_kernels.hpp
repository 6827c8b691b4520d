// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "horizon/receiver_packet.hpp"

/// The inner loops of bounds that hold between the azimuths. Rows of wedges are arrays float[wedge][receiver], as those of
/// horizons. docs/concepts.md, "The sky of a wedge".
namespace farlod {

/// What all wedges of even azimuths have in common.
struct WedgeShape {
  float angle, cosine, sine, tangent;
  /// An edge that is no steeper than t at its ends within a wedge is nowhere steeper than this times t: 1 / cos(angle / 2).
  float widened;
};

// --- Edges and their ends
// --------------------------------------------------------------------------------------------------------

/// Sixteen places where edges end; lanes without one are infinitely deep.
struct EndBatch {
  alignas(64) float x[16], y[16], z[16];
};
/// The lower one of the two horizons of each wedge: rows. And the least of all receivers: of each wedge, and of 2, 4, 8 ... from
/// each on.
struct LowerHorizons {
  float *rows, *minima;
};
/// Sixteen edges that may reach into a wedge.
struct WedgeEdges {
  alignas(64) float ax[16], ay[16], az[16], bx[16], by[16], bz[16];

  // In kernels, it must not be emitted on its own
  [[gnu::always_inline]] void put(std::size_t lane, const Point3f& a, const Point3f& b) {
    ax[lane] = a.x;
    ay[lane] = a.y;
    az[lane] = a.z;
    bx[lane] = b.x;
    by[lane] = b.y;
    bz[lane] = b.z;
  }
};
/// A receiver looks in a direction within a wedge, above a slope.
struct LookInWedge {
  std::uint32_t wedge, wedges;
  float x, y, z, cosine, sine, above;
};
/// The border that is highest there, by its number; −1 if there is none.
struct HighestBorder {
  float slope;
  std::int32_t number;
};
struct WedgeEndKernels {
  /// Finds them from the horizons at the azimuths.
  void (*find_lower)(const float* slopes, std::size_t azimuths, const LowerHorizons& lower);
  /// tops = max(tops, the slope of each end), in the wedge where each receiver sees it: at least where that is above `lower`.
  void (*raise_tops)(std::span<const EndBatch> ends, const ReceiverPacket& receivers, const CenteredBox& box,
                     const AzimuthView& azimuths, const LowerHorizons& lower, float* tops);
  /// Keeps the spans of edges that may be steeper than the least of all receivers (LowerHorizons::minima) in some wedge that they
  /// reach into. Returns how many there are.
  std::size_t (*keep_rising)(const EdgeSpans& spans, std::size_t edges, const float* minima, std::uint32_t wedges,
                             const RoomForSpans& kept);
  /// Lists the edges that reach into a wedge and may be steeper than a slope: their numbers. Returns how many. Spans up to the
  /// next multiple of 16 are read: they reach into no wedge.
  std::size_t (*list_reaching)(const EdgeSpans& spans, std::size_t edges, std::uint32_t wedge, std::uint32_t wedges, float slope,
                               std::uint32_t* numbers);
  /// The highest of those of the edges that reach into the wedge. Their ends are those of their numbers (BorderEnds). Of two at
  /// the same slope it is the one with the lower number, in whatever order they are.
  HighestBorder (*find_highest)(const EdgeSpans& spans, std::size_t edges, std::span<const BorderEnds::End> ends,
                                const LookInWedge& look);
  /// Marks the wedges into which edges reach that may be steeper there than the least of all receivers.
  void (*mark_reached)(const EdgeSpans& spans, std::size_t edges, const float* minima, std::uint32_t wedges, std::uint8_t* marks);
};

// --- The sky of wedges
// -----------------------------------------------------------------------------------------------------------

/// Numbers of horizons that are no edge's: the receiver's own plane, and what is behind a wall. −1: level, as in kernels.hpp.
inline constexpr std::int32_t number_of_plane = -2, number_behind = -3;

/// How the sky is weighed: by the cosine for receivers that look straight up, and for any; or by solid angle.
enum class WedgeWeight : std::uint8_t { cosine_up, cosine, solid_angle };

/// The horizons of edges, and the numbers of the edges.
struct NumberedHorizon {
  const float* slopes;
  const std::int32_t* numbers;
};
/// Rows of wedges: the slopes below which everything else hides the sky at least, and at most.
struct HidingRows {
  const float *least, *most;
};
/// Rows of wedges: the lower borders of what overhangs; and the wedges in which these count.
struct AskedBorders {
  const float* borders;
  const std::uint8_t* wedges;
};
/// The sky of simple wedges in radians, at least and at most. The terms of each wedge go to rows, unless they are null.
struct SimpleSums {
  alignas(64) float low[16], high[16];
  float *low_rows = nullptr, *high_rows = nullptr;
};

/// Sixteen edges, from p to q, relative to a receiver.
struct EdgesSeen {
  alignas(64) float px[16], py[16], pz[16], qx[16], qy[16], qz[16];
};
/// Sixteen wedges of a receiver, with the edges that are highest at the first azimuth and at the last one.
struct WedgePairs {
  EdgesSeen first, last;
  alignas(64) float cosine[16], sine[16];
  alignas(64) float from[16], to[16];    ///< the horizons that were drawn at both azimuths
  alignas(64) float top[16], least[16];  ///< below `top` is all that hides the sky of the wedge, and below `least` no sky
  float normal_x, normal_y, normal_z;
};
/// What is known of them from both edges alone. Where one follows the other (τ); the heights of both in the picture plane, at the
/// azimuths and there; and how far they are apart.
struct PairsAnswer {
  alignas(64) float turn[16], first[16], before[16], after[16], last[16], gap[16];
  alignas(64) float low[16], high[16];  ///< bounds of the sky, in radians
  alignas(64) float lid[16];            ///< a slope below which both hide all of the wedge
  std::uint32_t unknown;                ///< a bit for each wedge that nothing is known of
};
/// The most sky in their gaps, in radians; and a slope below which both edges hide all of the wedge.
struct GapsOfPairs {
  alignas(64) float most[16], lid[16];
};
/// A receiver's wedge, and heights in its picture plane at τ = 0, `turn` and the tangent of its angle.
struct WedgeEye {
  float x, y, z, cosine, sine, tangent;
  float turn = 0.0F, first = 0.0F, middle = 0.0F, last = 0.0F;
};

struct WedgeSkyKernels {
  /// Horizons raised to the receivers' own planes, below which they see nothing.
  void (*raise_to_planes)(const float* slopes, const std::int32_t* numbers, const ReceiverPacket& receivers,
                          const AzimuthView& azimuths, float* raised, std::int32_t* raised_numbers);
  /// A wedge is simple where one edge is highest at both azimuths, and no end rises above its horizons (`tops`): there it hides
  /// all that edges hide. Sums up the sky of these, and sets a bit for each receiver for whom a wedge is not simple. By the
  /// cosine, but for cosine_up, the terms of upright borders are left out, since they cancel from wedge to wedge. Not for
  /// receivers that look down.
  void (*sum_simple)(const NumberedHorizon& horizon, const HidingRows& hiding, const ReceiverPacket& receivers,
                     const AzimuthView& azimuths, const WedgeShape& shape, WedgeWeight weight, std::uint16_t* others,
                     const float* tops, SimpleSums& sums);
  /// The same for the sky between the edges and higher borders, at most: rows of it.
  void (*find_simple_gaps)(const NumberedHorizon& horizon, const AskedBorders& asked, const ReceiverPacket& receivers,
                           const AzimuthView& azimuths, const WedgeShape& shape, WedgeWeight weight, std::uint16_t* others,
                           const float* tops, float* gaps);
};

struct WedgePairKernels {
  /// The sky of wedges that are not simple, from both edges alone, in the same terms.
  void (*bound_pairs)(const WedgePairs& pairs, const WedgeShape& shape, WedgeWeight weight, PairsAnswer& answer);
  /// The most sky between both edges and higher borders, which hides only what they do. Below `top`, all that hides sky of the
  /// wedge is.
  void (*bound_gaps)(const WedgePairs& pairs, const float* borders, const WedgeShape& shape, WedgeWeight weight,
                     GapsOfPairs& gaps);
  /// The edges that may rise above an envelope through three heights: a bit for each.
  std::uint32_t (*find_above)(const WedgeEdges& edges, const WedgeEye& eye);
  /// A height below which one of the edges hides all of the wedge, by its ends alone; 0 if none does. `turn` and heights are not
  /// read.
  float (*find_lid)(const WedgeEdges& edges, const WedgeEye& eye);
};

}  // namespace farlod
