// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

/// Reads a CityGML file as a stream: besides the city it holds one building in memory. Reads the file again only when buildings
/// refer to surfaces outside of themselves. A file of terrain alone is a city without buildings. Throws InputError for a file
/// that is not well-formed XML (with line and column), is not CityGML, or has neither buildings nor terrain, and for attacks on
/// the parser (see parse_xml).
[[nodiscard]] SourceCity read_citygml(const InputFile& file, LodChoice lod, Report& report);

}  // namespace farlod::ingest
