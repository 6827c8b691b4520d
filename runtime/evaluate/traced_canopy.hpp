// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "evaluate/sky_directions.hpp"
#include "farlod/point.hpp"
#include "horizon/sky_profile.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/occluder.hpp"
#include "package/far_map_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// What crowns take of the view of a receiver.
struct CanopyLoss {
  float light = 0.0F;     ///< svf − svf_total
  float sky = 0.0F;       ///< 1 − svfveg: the sky behind crowns
  float building = 0.0F;  ///< 1 − svfaveg: what is solid, behind crowns
  /// Twice the parts of `sky` and of `building` in the halves of the sky, where somebody asked for them.
  std::array<float, SkyHalves::count> sky_of_half{}, building_of_half{};
};

/// Solid things and crowns, in one frame.
struct CanopyScene {
  const Occluder& solid;
  const CrownOccluder& crowns;
  const BoxFarMap* far = nullptr;  ///< what is solid beyond `solid` and all crowns; null where nothing is
};

/// Whether a crown that a ray enters at this distance is met before anything solid. Distances count in the direction's length.
[[nodiscard]] bool is_crown_first(const Occluder& solid, const RayOrigins& origins, std::size_t lane, const Point3f& direction,
                                  float entry);

/// Directions, each of which stands for 1 / ray_count of the view, and the halves of the sky that each lies in: none where nobody
/// asks for the halves.
struct TracedDirections {
  std::span<const Point3d> directions;
  std::span<const SkyHalves::Bits> halves;
  std::size_t ray_count;
};

/// The losses of each origin, by rays: the judge of all other ways. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<CanopyLoss> trace_canopies(const CanopyScene& scene, std::span<const Point3f> origins,
                                                     const TracedDirections& traced, const std::stop_token& stop = {});

/// The sky of a receiver without its crowns.
struct SkyOfReceiver {
  SvfInterval svf;    ///< as it is answered
  SvfInterval drawn;  ///< that of the profile which the crowns are counted above, for its azimuths
};

/// The sky view factor with crowns, and what it certainly lies between, where the loss is that of the profile and differs from
/// that of all crowns by `most_error` at the most. docs/concepts.md, "Bounds with crowns".
[[nodiscard]] SvfInterval svf_total_of(const SkyOfReceiver& sky, float lost, float most_error);

/// That of receivers of one cell, by rays in their directions against all that there is.
[[nodiscard]] std::vector<float> trace_svf_totals(const CanopyScene& city, Point2d scene_from_cell_m,
                                                  const SkyDirections& directions, std::span<const Receiver> receivers,
                                                  const std::stop_token& stop);

}  // namespace farlod
