// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace farlod {

/// Gives two folders each other's name, in one step where the file system can (renameat2). Where it cannot, as over NFS, `there`
/// has no folder for a moment: `aside` is the name that its folder has meanwhile. Throws OutputError; both keep their names then.
void swap_folders(const std::filesystem::path& here, const std::filesystem::path& there, const std::filesystem::path& aside);

/// Moves a folder to a name that nobody has. Throws OutputError.
void move_folder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace farlod
