// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "package/manifest.hpp"

namespace farlod {

[[nodiscard]] package::FileStamp stamp_of(std::span<const std::byte> bytes);
/// Reads the file piece by piece. Throws InputError when it cannot be read.
[[nodiscard]] package::FileStamp stamp_of(const std::filesystem::path& path);

/// Whether the files of a block are those that were written.
[[nodiscard]] bool are_whole(const std::filesystem::path& package, const package::BlockFiles& files);
/// Whether its files besides the blocks are whole: crowns, and the places that surfaces come from.
[[nodiscard]] bool are_others_whole(const std::filesystem::path& package, const package::Manifest& manifest);

}  // namespace farlod
