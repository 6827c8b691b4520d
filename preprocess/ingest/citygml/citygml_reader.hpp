// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

/// Streams a CityGML file: memory is one building's, besides the city itself. Reads the file again only when buildings
/// refer to surfaces outside of themselves. A file of terrain alone is a city without buildings. Throws InputError for what
/// is not well-formed XML (with line and column), not CityGML, or has neither buildings nor terrain; and for what is meant
/// to do harm (see parse_xml).
[[nodiscard]] SourceCity read_citygml(const InputFile& file, LodChoice lod, Report& report);

}  // namespace farlod::ingest
