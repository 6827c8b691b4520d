// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "farlod/light.hpp"
#include "radiation/sky_grid.hpp"

namespace farlod {

/// A position of the sun, and its energy on a plane that faces it.
struct SunLight {
  SunPosition sun;
  double energy = 0.0;
  bool goes_on = false;  ///< from the position before
};

/// The light of some intervals: where the sun is in them, and the sky of all of them.
struct SunAndSky {
  std::vector<SunLight> suns;
  SkyGrid sky;
};

/// The months of a period that irradiation has columns for, ascending: none unless they are asked for.
[[nodiscard]] std::vector<unsigned> months_by_name(const Light& light);

/// The light of a period, at whatever azimuths it is asked for later: to add up the skies of a year takes longer than a table of
/// them.
struct LightOfPeriod {
  LightOfPeriod(const Light& light, bool with_illuminance);

  std::vector<unsigned> months;          ///< months_by_name
  std::vector<SunAndSky> energy;         ///< in kWh/m², of each of these months; of the whole period where there are none
  std::optional<SunAndSky> illuminance;  ///< in lx h
  double hours = 0.0, hours_of_illuminance = 0.0;
};

}  // namespace farlod
