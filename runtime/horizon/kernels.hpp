// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "package/horizon_edge.hpp"

/// The inner loops of the horizon engine, for sixteen receivers or edges at once. edge_kernels.cpp and sky_kernels.cpp are
/// compiled once for each target, a generation of processors; all targets give the same bits.
/// docs/decisions/0015-portable-kernels.md.
///
/// Horizons, and rows of horizons, are arrays float[azimuth][receiver], with 16 receivers: value k * 16 + l is that of the
/// receiver l at the azimuth k. A slope is the tangent of an elevation, at least 0.
namespace farlod {

/// Edges of one role, 16 a batch (SilhouetteEdges).
struct EdgeBatches {
  std::span<const SilhouetteEdges::Batch> batches;
  EdgeRole role;
};

/// What is known of the edges that a horizon is raised to, from near to far: when its lowest slopes are found, against which
/// edges are culled, and how soon again. The horizons that are drawn do not depend on it.
enum class Culling : std::uint8_t {
  nothing_drawn,  ///< before the first edge, and soon again: the nearest hide the most
  mostly_drawn,   ///< before the first edge: the horizon is most of what it will be
  mostly_seen     ///< after some edges: most of them are seen
};

/// Where an edge may rise above a horizon: at the azimuths; or also between two, above the lower one of both horizons.
enum class RaisingAt : std::uint8_t { azimuths, wedges };

/// For each of some edges its number, the wedges that it reaches into for some receiver, so many from the first on, around the
/// turn; and a slope that it is nowhere steeper than. A *wedge* leads from an azimuth to the next one, and has the number of its
/// first azimuth.
struct EdgeSpans {
  const std::uint32_t* number;
  const std::int32_t *first, *count;
  const float* max_slope;
};
struct RoomForSpans {
  std::uint32_t* number;
  std::int32_t *first, *count;
  float* max_slope;
};

/// Rows of slopes; the number of the edge of each slope, or null; and room for spans of all edges that are drawn, or null.
struct DrawnRows {
  float* slopes;
  std::int32_t* numbers = nullptr;
  RoomForSpans drawn = {};
};

struct EdgeKernels {
  /// For each edge its distance in the plan from the centre of a box of receivers, or −1 if it can be a silhouette for none of
  /// them: may_be_silhouette (package/horizon_edge.hpp) and a test of its height, in floats.
  ///   (1) an edge that may_be_silhouette keeps is kept, unless no end is above the box's floor
  ///   (2) other edges are kept only within rounding
  /// distances_m[batch][lane]; lanes without an edge mean nothing.
  void (*find_facing)(const EdgeBatches& edges, const CenteredBox& box, float* distances_m);
  /// The edges that may rise above some horizon of packets whose receivers lie within these bounds: a bit for each lane of each
  /// batch, raising[batch]. An edge that is not among them raises none. Bits of lanes without an edge mean
  /// nothing.
  void (*find_raising)(const EdgeBatches& edges, const PacketBounds& bounds, std::span<const float* const> horizons,
                       const AzimuthView& azimuths, RaisingAt where, std::uint16_t* raising);
  /// Raises horizons to edges: slopes = max(slopes, slope of each edge where a receiver sees it). Where that raises a slope,
  /// numbers[azimuth][receiver] becomes that of the edge. Returns how many spans were written. All edges that rise above the
  /// lower one of both horizons of a wedge, somewhere in it, are among them.
  std::size_t (*raise_to_edges)(const EdgeBatches& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                                const AzimuthView& azimuths, Culling culling, const DrawnRows& rows);
  /// Lowers horizons to the edges above `min_slopes`: slopes = min(slopes, slope of each edge that is steeper than min_slopes).
  void (*lower_to_edges)(const EdgeBatches& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                         const AzimuthView& azimuths, const float* min_slopes, float* slopes);
};

/// Slopes of a far map's bins between two of its levels, for PacketHorizon::raise.
struct ResidualRows {
  std::span<const float> here, above, lower, upper;
  ReceiverPacket::Lanes shares, caps;
};

/// A ray that lies between two azimuths, or along one of them.
struct RayBetweenAzimuths {
  std::uint32_t before, after;
  float slope;
};

/// From this azimuth to the next, the sky of the receivers with set bits jumps.
struct SkyJump {
  std::uint32_t azimuth, receivers;
};

struct SkyKernels {
  /// Σ over the azimuths of the sky above each horizon, F(φ) of docs/concepts.md, "Above a horizon": for receivers whose normals
  /// point straight up; for level normals; for any; and by solid angle for any. sums[receiver]. The terms go to rows[azimuth]
  /// [receiver], unless `rows` is null.
  void (*sum_cosine_up)(const float* slopes, std::size_t azimuth_count, float* sums, float* rows);
  void (*sum_cosine_level)(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums,
                           float* rows);
  void (*sum_cosine)(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums, float* rows);
  void (*sum_solid_angle)(const float* slopes, const ReceiverPacket& receivers, const AzimuthView& azimuths, float* sums,
                          float* rows);
  /// Finds where rows change by more than `least` from one azimuth to the next, the last one's next being the first, and the
  /// horizons are of different edges. Returns their number, at most one for each azimuth, in the order of the azimuths.
  std::size_t (*find_jumps)(const float* rows, const std::int32_t* numbers, std::size_t azimuth_count, float least,
                            SkyJump* jumps);
  /// rows[k] = share of the SVF between the slopes low[k] and high[k], at least 0.
  void (*find_sky_between)(const float* low, const float* high, const ReceiverPacket& receivers, const AzimuthView& azimuths,
                           bool is_solid, float* rows);

  /// slopes = min(slopes, other), and the maximum.
  void (*lower)(const float* other, std::size_t azimuth_count, float* slopes);
  void (*raise)(const float* other, std::size_t azimuth_count, float* slopes);
  /// slopes = slopes where they are finite, otherwise `other`.
  void (*replace_infinite)(const float* other, std::size_t azimuth_count, float* slopes);
  /// slopes = max(slopes, upper) where lower ≤ slopes.
  void (*join)(const float* lower, const float* upper, std::size_t azimuth_count, float* slopes);
  /// differences[receiver] = max over the azimuths of slopes − other, at least −1.
  void (*find_max_difference)(const float* slopes, const float* other, std::size_t azimuth_count, float* differences);
  /// counts[receiver] = number of azimuths k at which the horizon lies below ray_slopes[k].
  void (*count_above)(const float* slopes, const float* ray_slopes, std::size_t azimuth_count, float* counts);

  /// above[ray] = a bit for each receiver whose horizons at both azimuths lie below the ray.
  void (*find_rays_above)(const float* slopes, std::span<const RayBetweenAzimuths> rays, std::uint16_t* above);

  /// slopes = max(slopes, min(row[bin of the azimuth], caps)).
  void (*raise_to_row)(const float* row, const float* caps, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count,
                       float* slopes);
  /// The same to here + shares (above − here), clamped to [lower, upper]. Where that is no lower than the slope,
  /// numbers[azimuth][receiver] becomes −1; `numbers` may be null.
  void (*raise_between_rows)(const ResidualRows& rows, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count,
                             float* slopes, std::int32_t* numbers);
};

struct GapKernels;
struct WedgeEndKernels;
struct WedgeSkyKernels;
struct WedgePairKernels;
struct WedgeGapKernels;
struct PixelKernels;
struct LightKernels;

/// All kernels, compiled for one target.
struct KernelTarget {
  const char* name;
  const EdgeKernels* edge;
  const SkyKernels* sky;
  const GapKernels* gap;
  const WedgeEndKernels* wedge_end;
  const WedgeSkyKernels* wedge_sky;
  const WedgePairKernels* wedge_pair;
  const WedgeGapKernels* wedge_gap;
  const PixelKernels* pixel;
  const LightKernels* light;
};

/// The targets that this processor can run, the fastest first; the last one is `baseline`, which any can.
[[nodiscard]] std::span<const KernelTarget> runnable_kernels();

/// The fastest of them.
[[nodiscard]] const EdgeKernels& edge_kernels();
[[nodiscard]] const SkyKernels& sky_kernels();
[[nodiscard]] const GapKernels& gap_kernels();
[[nodiscard]] const WedgeEndKernels& wedge_end_kernels();
[[nodiscard]] const WedgeSkyKernels& wedge_sky_kernels();
[[nodiscard]] const WedgePairKernels& wedge_pair_kernels();
[[nodiscard]] const WedgeGapKernels& wedge_gap_kernels();
[[nodiscard]] const PixelKernels& pixel_kernels();
[[nodiscard]] const LightKernels& light_kernels();

}  // namespace farlod
