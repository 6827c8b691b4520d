// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

/// Reads CityJSON 1.0 to 2.0, or CityJSONSeq line by line. Throws InputError for a file that is not JSON (with line and column),
/// is not CityJSON, or has neither buildings nor a relief.
[[nodiscard]] SourceCity read_cityjson(const InputFile& file, LodChoice lod, Report& report);

}  // namespace farlod::ingest
