// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "farlod/light.hpp"
#include "sun/sun_positions.hpp"
#include "weather/weather.hpp"

namespace farlod {

/// The intervals of light, and what of the weather there is no sun for: sentences, for people.
struct LightOfWeather {
  std::vector<LightInterval> intervals;
  std::vector<std::string> remarks;
};

/// What weather means at a place: an interval is divided into equal steps, no longer than `step`, and the sun stands in the
/// middle of each, refracted by the mean air of the weather. Months are those of the weather's clock.
[[nodiscard]] LightOfWeather light_of(const Weather& weather, const PlaceOnEarth& place, std::chrono::milliseconds step);

}  // namespace farlod
