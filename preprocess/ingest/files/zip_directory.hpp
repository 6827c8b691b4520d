// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace farlod::ingest {

/// An entry of the central directory of a zip archive.
struct ZipListing {
  std::string name;        ///< printable
  bool is_locked = false;  ///< encrypted with a password
};

/// Reads the central directory alone. Empty when there is none, or when it has more than 256 MiB.
[[nodiscard]] std::vector<ZipListing> zip_listings(const std::filesystem::path& archive);

/// A name that is safe to show: control characters become "?".
[[nodiscard]] std::string printable(std::string_view name);

/// Whether a name leads out of its archive: it is absolute, or has a drive or `..`.
[[nodiscard]] bool leads_outside(std::string_view name);

}  // namespace farlod::ingest
