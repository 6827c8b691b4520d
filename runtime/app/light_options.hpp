// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "farlod/quantities.hpp"
#include "weather/period.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// Where the light of a period comes from.
struct LightRequest {
  std::filesystem::path weather_file;  ///< empty: the sky is clear, and the period is given
  std::optional<Period> period;        ///< none: all of the weather
  std::chrono::minutes step{5};
  double linke_turbidity = 3.0;  ///< of the clear sky
};

/// What the options of this file say, as text.
struct RawLight {
  std::string weather_file, period, sky_model = "perez", albedo, by;
  std::optional<double> linke_turbidity;
  std::size_t step_minutes = 0;
};

void add_light_options(CLI::App& app, RawLight& raw);

/// What they mean for these quantities, which take on what is known of their light, but for its intervals; nothing where none of
/// them has any light. Throws CLI::ValidationError.
[[nodiscard]] std::optional<LightRequest> resolved_light(const RawLight& raw, Quantities& quantities);

}  // namespace farlod
