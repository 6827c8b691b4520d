// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Whether a file is CityJSON or CityJSONSeq, by the members of its first JSON object. Reads no farther than needed. A file that
/// is not JSON up to there is not CityJSON.
[[nodiscard]] bool is_cityjson(const InputFile& file);

}  // namespace farlod::ingest
