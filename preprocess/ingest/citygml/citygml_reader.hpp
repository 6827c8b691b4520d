// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stop_token>

#include "city/city_model.hpp"
#include "ingest/citygml/citygml_reading.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// Reads a file in segments, on all threads of the task arena that it is called in. The result is that of reading the file as a
/// whole. Empty for a file that has to be read as a whole, and for one of a single segment: reading it then gives the result, or
/// says what is wrong, and where. Throws Cancelled when a stop is requested.
[[nodiscard]] std::optional<CityGmlContents> read_in_segments(const ReadingTask& task);

/// Reads a CityGML file as a stream: besides the city it holds in memory one building or, on several threads of the task arena
/// that it is called in, two segments for each. The result does not depend on their number. Reads the file again only when
/// buildings refer to surfaces outside of themselves, and when a segment cannot be read by itself. A file of terrain alone is a
/// city without buildings. Throws InputError for a file that is not well-formed XML (with line and column), is not CityGML, or
/// has neither buildings nor terrain, and for attacks on the parser (see parse_xml); Cancelled when a stop is requested.
[[nodiscard]] SourceCity read_citygml(const InputFile& file, LodChoice lod, Report& report, const std::stop_token& stop = {},
                                      const SegmentSizes& segments = {});

}  // namespace farlod::ingest
