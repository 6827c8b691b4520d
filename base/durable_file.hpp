// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace farlod {

/// Writes a file that is whole when it has its name, whatever ends the process or the power: its bytes are on the disk before.
/// Replaces an older one. Throws OutputError.
void write_durably(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_durably(const std::filesystem::path& path, std::string_view text);

/// The same for a file that `write` writes to the temporary name that it is given. What it throws comes out.
void write_durably(const std::filesystem::path& path, const std::function<void(const std::filesystem::path& temporary)>& write);

/// Whether a file's name is one that write_durably() gives a file that is not whole.
[[nodiscard]] bool is_unfinished_file(const std::filesystem::path& path);

/// Makes the names in a folder outlive a power cut, as far as the file system can.
void settle_names_in(const std::filesystem::path& folder);

}  // namespace farlod
