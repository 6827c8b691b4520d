// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace farlod::ingest {

/// A file as the list at the end of a zip archive names it.
struct ZipListing {
  std::string name;        ///< printable
  bool is_locked = false;  ///< by a password
};

/// Reads the list, and nothing else. Empty when there is none, or when it is of an archive of more than 4 GiB or 65,535 files.
[[nodiscard]] std::vector<ZipListing> zip_listings(const std::filesystem::path& archive);

/// A name as it may be shown: what would move a terminal's cursor becomes "?".
[[nodiscard]] std::string printable(std::string_view name);

/// Whether a name leads out of the archive that it is in: absolute, with a drive, or with `..`.
[[nodiscard]] bool leads_outside(std::string_view name);

}  // namespace farlod::ingest
