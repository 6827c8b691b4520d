// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ingest/citygml/citygml_reading.hpp"

namespace farlod::ingest {

/// Reads a file in segments, on all threads of the task arena that it is called in. The result is that of reading the file as a
/// whole. Empty for a file that has to be read as a whole, and for one of a single segment: reading it then gives the result, or
/// says what is wrong, and where. Throws Cancelled when a stop is requested.
[[nodiscard]] std::optional<CityGmlContents> read_in_segments(const ReadingTask& task);

}  // namespace farlod::ingest
