// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "evaluate/sky_directions.hpp"
#include "evaluate/traced_canopy.hpp"
#include "farlod/point.hpp"
#include "horizon/svf_interval.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The sky of a receiver without its crowns.
struct SkyOfReceiver {
  SvfInterval svf;       ///< as it is answered
  SvfInterval drawn;     ///< that of the profile which the crowns are counted above
  bool is_drawn = true;  ///< whether the answer is made of the profile, and not of rays
};

/// The sky view factor with crowns, and what it certainly lies between, where the loss is that of the profile and differs from
/// that of all crowns by `most_error` at the most. docs/concepts.md, "Bounds with crowns".
[[nodiscard]] SvfInterval svf_total_of(const SkyOfReceiver& sky, float lost, float most_error);

/// That of receivers of one cell, by rays in their directions against all that there is.
[[nodiscard]] std::vector<float> trace_svf_totals(const CanopyScene& city, Point2d scene_from_cell_m,
                                                  const SkyDirections& directions, std::span<const Receiver> receivers,
                                                  const std::stop_token& stop);

}  // namespace farlod
