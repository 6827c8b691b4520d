// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace farlod {

/// What to tell a user whose file cannot be read, in one sentence that begins with its name and says what to do: it does not
/// exist, and perhaps another one with nearly that name does; it is an address of the web, a folder, empty; or it may not be
/// read.
[[nodiscard]] std::string why_unread(const std::filesystem::path& file);

/// The names in a folder, in a fixed order; none where it cannot be read. Of a folder with more than anybody looks through, only
/// some.
[[nodiscard]] std::vector<std::string> names_in_folder(const std::filesystem::path& folder);

}  // namespace farlod
