// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "farlod/building_origin.hpp"

namespace farlod {

[[nodiscard]] std::string name_of(CityFileFormat format);
/// The format of a city file that the ending of its name promises, in capitals or not.
[[nodiscard]] std::optional<CityFileFormat> city_format_of(const std::filesystem::path& path);
/// For messages: ".gml, .xml or .citygml".
[[nodiscard]] std::string endings_of(CityFileFormat format);

}  // namespace farlod
