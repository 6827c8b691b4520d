// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// The files in a zip archive, ordered by name. Nothing is unpacked and nothing is written. Names that lead out of the archive
/// (leads_outside) are left out. Links are not followed. Throws InputError when the archive cannot be read, holds more files than
/// a city has, or declares to unpack to more than most_unpacked_bytes.
[[nodiscard]] std::vector<InputFile> files_in_zip(const std::filesystem::path& archive);

}  // namespace farlod::ingest
