// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "city/source.hpp"
#include "ingest/city_writer.hpp"
#include "ingest/lod_choice.hpp"

namespace farlod {

/// Streams a CityGML file: memory is one building's, besides the city itself. Reads the file again only when buildings
/// refer to surfaces outside of themselves. Throws InputError for what is not well-formed XML (with line and column), not
/// CityGML, or without buildings.
[[nodiscard]] SourceCity read_citygml(const std::filesystem::path& file, LodChoice lod, Report& report);

}  // namespace farlod
