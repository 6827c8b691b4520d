// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "city/source.hpp"
#include "farlod/problem.hpp"
#include "ingest/lod_choice.hpp"

namespace farlod {

/// Whether a file is CityJSON or CityJSONSeq: it begins with a JSON object that says so. Reads no farther than needed.
/// Throws InputError when it is not JSON up to there.
[[nodiscard]] bool is_cityjson(const std::filesystem::path& file);

/// Reads CityJSON 1.0 to 2.0, or CityJSONSeq line by line. Throws InputError for what is not JSON (with line and column),
/// not CityJSON, or without buildings.
[[nodiscard]] SourceCity read_cityjson(const std::filesystem::path& file, LodChoice lod, Report& report);

}  // namespace farlod
