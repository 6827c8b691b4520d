// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "city/city_model.hpp"
#include "generator/city_settings.hpp"

namespace farlod::scenes {

/// The generator's city as a city model, in the city frame around the city's centre.
[[nodiscard]] CityModel generated_town(const CitySettings& settings);

}  // namespace farlod::scenes
