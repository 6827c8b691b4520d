// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "canopy/canopy_march.hpp"
#include "canopy/crown_batches.hpp"
#include "canopy/dimmed_sky.hpp"
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
  float max_slope;             ///< of all receivers at most; infinity if it is too close for a bound
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

/// A crown in its place before the receivers, ready to be cut at any azimuth: the members of RoundCrown or of SquareCrown
/// (crown_sections.hpp), in their order.
struct PlacedCrown {
  alignas(64) std::array<ReceiverPacket::Lanes, 7> rows;
  float max_slope;                 ///< of all receivers at most
  float half_width, cosine, sine;  ///< of a prism
  bool is_prism;
};

/// Numbers of crowns, listed for each azimuth: from begins[k] to ends[k].
struct CrownLists {
  const std::uint32_t* begins;
  std::uint32_t *ends, *numbers;
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
  float* behind = nullptr;  ///< takes the sky behind crowns, F of each azimuth: rows, or null
  DimmedTaker dimmed = {};
};

/// What is wanted of the sky behind crowns besides its sum.
struct BehindRows {
  float* behind = nullptr;  ///< takes F of each azimuth: rows, or null
  DimmedTaker dimmed = {};
};

/// Sums over the azimuths, for each receiver: of the sky that crowns take away, and of that which is behind crowns.
struct CrownSums {
  alignas(64) ReceiverPacket::Lanes lost, behind;
};

struct CrownKernels {
  /// The slopes below which nothing counts for any receiver: one for each azimuth.
  void (*find_lowest_ground)(const SkyRows& sky, const CrownScene& scene, float* lowest);
  /// The crowns that may rise above the lowest ground of some packet for some receiver within the box. Returns their number.
  std::size_t (*find_seen)(const CrownScene& scene, const CenteredBox& box, std::span<const float* const> lowest,
                           SeenCrown* seen);
  /// Appends each crown to the lists of the azimuths at which it may rise above the lowest ground, which has sixteen values more
  /// than there are azimuths. Keeps those that are in a list, to whose places the numbers lead, and returns how many.
  std::size_t (*list)(std::span<SeenCrown> seen, const float* lowest, std::uint32_t azimuths, const CrownLists& lists);
  /// Puts crowns in their places before the receivers.
  void (*place)(const CrownScene& scene, std::span<const SeenCrown> seen, PlacedCrown* placed);
  /// The share of the sky behind the crowns of lists: `sum`, one number a receiver. `room` has place for two rows for each crown
  /// of the longest list, and two more.
  void (*sum_behind)(const SkyRows& sky, const CrownScene& scene, const CrownLists& lists, const PlacedCrown* placed, float* room,
                     const BehindRows& wanted, float* sum);
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
  const CanopyMarchKernels* march;
};
/// Those that this processor can run, the fastest first.
[[nodiscard]] std::span<const CrownTarget> runnable_crown_kernels();
/// The fastest of them.
[[nodiscard]] const CrownTarget& crown_kernels();

}  // namespace farlod
