// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "farlod/canopy.hpp"
#include "package/crown.hpp"

namespace farlod {

/// Whether a crown has shed its leaves.
[[nodiscard]] inline bool is_bare(Foliage foliage, Season season) {
  return season == Season::leaf_off && foliage != Foliage::evergreen;
}

/// ψ of a crown in a run: the share of the light that passes it.
[[nodiscard]] inline double transmissivity_of(Foliage foliage, const CanopySettings& settings) {
  if (is_bare(foliage, settings.season)) return settings.transmissivity.value_or(leaf_off_transmissivity);
  return settings.season == Season::leaf_on ? settings.transmissivity.value_or(leaf_on_transmissivity) : leaf_on_transmissivity;
}

/// κ of a crown in a run, in 1/m.
[[nodiscard]] inline double extinction_per_m_of(Foliage foliage, const CanopySettings& settings) {
  const double of_bare = std::log(leaf_off_transmissivity) / std::log(leaf_on_transmissivity);
  return is_bare(foliage, settings.season) ? of_bare * settings.extinction_per_m : settings.extinction_per_m;
}

}  // namespace farlod
