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
/// Of each kind of model that farlod-city makes, a town of `size_m`.
[[nodiscard]] std::vector<StudiedCity> generated_models(double size_m);
/// Buildings of any file, read by the stages of farlod-pack.
[[nodiscard]] StudiedCity building_city(const std::string& name, const std::filesystem::path& file);
/// Footprints with heights, read by the stages of farlod-pack.
[[nodiscard]] StudiedCity footprint_city(const std::string& name, const std::filesystem::path& file,
                                         const std::string& height_field);

}  // namespace farlod::validation
