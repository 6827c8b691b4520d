// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "canopy/crown_batches.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"

/// The inner loops of what crowns do to the sky, for the sixteen receivers of a packet at once. crown_kernels.cpp and
/// crown_light_kernels.cpp are compiled once for each target, as those of horizon/kernels.hpp are; all targets give the same
/// bits.
///
/// Rows are arrays float[azimuth][receiver], as in horizon/kernels.hpp. Each receiver's sums depend on its own place and normal
/// and on the crowns, and not on what else is in its packet. docs/concepts.md, "Crowns".
namespace farlod {

/// An optical depth that counts as infinite: less than 2e-35 of the light passes.
inline constexpr float opaque_depth = 80.0F;

/// A crown that some receiver of a packet may see, at the azimuths `first`, `first + 1` … of a turn, counted on over its end.
struct SeenCrown {
  std::uint32_t crown;         ///< batch · 16 + lane
  std::uint32_t first, count;  ///< at most a whole turn
  float min_slope, max_slope;  ///< bounds of what all receivers see of it; 0 and infinity if it is too close for bounds
  float distance;              ///< in the plan, from the middle of the packet
};

/// Where the sky of a packet is seen: above `sky_from`, and in gaps below it with a share. Rows; those of gaps are null if there
/// is no gap.
struct SkyRows {
  const float *sky_from, *gap_from, *gap_to, *gap_share;
  const float* sky;  ///< F(φ) above `sky_from` with the jumps of the horizon where they are, or null
};

/// What a kernel reads.
struct CrownScene {
  std::span<const CrownBatches::Batch> batches;
  const ReceiverPacket* receivers;
  AzimuthView azimuths;
  float range_square;  ///< crowns with an axis farther away than its root are not seen
  bool all_look_up;    ///< all normals point straight up
};

/// At each azimuth, what is hidden or behind crowns: slopes up to `ground`; from core_low to core_high; and the intervals of a
/// list. Rows.
struct CoverRows {
  float *ground, *core_low, *core_high;
  const std::uint32_t* begins;  ///< of the list of each azimuth
  std::uint32_t* counts;        ///< of its intervals, with a free first place
  float *low, *high;            ///< rows of the lists
  float* behind = nullptr;      ///< takes the sky behind what is covered, F of each azimuth: rows, or null
};

/// A crown at one azimuth, for all receivers: between which slopes they see it, and where. A spheroid's u and e, or the distances
/// in the plan at which a cylinder or a prism is entered and left.
struct CrownSection {
  alignas(64) ReceiverPacket::Lanes low, high, near, far;
};
struct SectionRows {
  const float* lowest_ground;
  const std::uint32_t* begins;  ///< of the sections of each azimuth
  std::uint32_t* counts;
  CrownSection* sections;
  std::uint32_t* crowns;    ///< of each section
  float* behind = nullptr;  ///< as that of CoverRows
};

/// Sums over the azimuths, for each receiver: of the sky that crowns take away, and of that which is behind crowns.
struct CrownSums {
  alignas(64) ReceiverPacket::Lanes lost, behind;
};

struct CrownKernels {
  /// The slopes below which nothing counts for a receiver: rows, and the lowest of each azimuth.
  void (*find_ground)(const SkyRows& sky, const CrownScene& scene, float* ground, float* lowest_ground);
  /// The crowns that may rise above this ground for some receiver within the box. Returns their number.
  std::size_t (*find_seen)(const CrownScene& scene, const CenteredBox& box, const float* ground, SeenCrown* seen);
  /// Draws crowns into what is covered.
  void (*cover)(const CrownScene& scene, std::span<const SeenCrown> seen, const CoverRows& covered);
  /// The share of the sky behind what is covered: `sum`, one number a receiver.
  void (*sum_covered)(const SkyRows& sky, const CrownScene& scene, const CoverRows& covered, float* sum);
};

struct CrownLightKernels {
  /// Cuts crowns at the azimuths at which they may be seen.
  void (*cut)(const CrownScene& scene, std::span<const SeenCrown> seen, const SectionRows& rows);
  /// Integrates the light that passes all sections, by the rule `each` or `beer`. `room` has place for four rows for
  /// each section of the azimuth with the most.
  void (*sum_light)(const SkyRows& sky, const CrownScene& scene, const SectionRows& rows, CanopyRule rule, float* room,
                    CrownSums& sums);
};

/// The kernels of a target, compiled for it.
struct CrownTarget {
  const char* name;
  const CrownKernels* cover;
  const CrownLightKernels* light;
};
/// Those that this processor can run, the fastest first.
[[nodiscard]] std::span<const CrownTarget> runnable_crown_kernels();
/// The fastest of them.
[[nodiscard]] const CrownTarget& crown_kernels();

}  // namespace farlod
