// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "city/city_model.hpp"
#include "farlod/angle.hpp"

namespace farlod::validation {

/// A city whose sky view factors are studied, in a city frame around its middle.
struct StudiedCity {
  std::string name;
  CityModel city;
  Angle streets;  ///< bearing of its streets
};

/// farlod-city --size `size_m` --seed 1 --towers 0.3 --rotation 20 --lod 1
[[nodiscard]] StudiedCity generated_city(double size_m);
/// Footprints with heights, read by the stages of farlod-pack.
[[nodiscard]] StudiedCity footprint_city(const std::string& name, const std::filesystem::path& file,
                                         const std::string& height_field);

}  // namespace farlod::validation
