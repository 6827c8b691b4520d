// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace farlod {

/// Asked before the work, which may take hours. No name needs no folder. Throws OutputError.
void require_folder_of(const std::filesystem::path& file);

/// Writes a file such as that of `--summary`; nothing without a name. Throws OutputError.
void write_text(const std::string& path, const std::string& text);

}  // namespace farlod
