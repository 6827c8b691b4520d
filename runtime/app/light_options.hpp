// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "farlod/quantities.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/weather.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// What the options of this file say, as text.
struct RawLight {
  std::string weather_file, period, sky_model = "perez", albedo, by;
  std::optional<double> linke_turbidity;
  std::size_t step_minutes = 0;
};

void add_light_options(CLI::App& app, RawLight& raw, SurfaceSettings& surfaces);

/// What they mean for these quantities, which take on what is known of their light, but for its intervals; nothing where none of
/// them has any light. Throws CLI::ValidationError.
[[nodiscard]] std::optional<LightSource> resolved_light(const RawLight& raw, Quantities& quantities);

}  // namespace farlod
