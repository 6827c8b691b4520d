// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Whether a file is CityJSON or CityJSONSeq: it begins with a JSON object that says so. Reads no farther than needed. What is no
/// JSON up to there is none.
[[nodiscard]] bool is_cityjson(const InputFile& file);

}  // namespace farlod::ingest
