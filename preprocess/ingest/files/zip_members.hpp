// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// The files in a zip archive, by name; nothing is unpacked for that, and nothing is ever written. Names that lead out of the
/// archive (leads_outside) are not among them, and links are files that hold the name of another, which is not followed.
/// Throws InputError when the archive cannot be read, holds more files than a city has, or claims to unpack to more than
/// most_unpacked_bytes.
[[nodiscard]] std::vector<InputFile> files_in_zip(const std::filesystem::path& archive);

}  // namespace farlod::ingest
