// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace farlod {

/// What made a result, and of what. Formats with room for it have it in their files; it has no date, since the same input gives
/// the same bytes.
struct Provenance {
  std::string software;       ///< with its version
  std::string package;        ///< name of its folder
  std::string manifest_xxh3;  ///< as xxh3_of_file(): the manifest has the checksums of all other files of the package
  std::string settings;       ///< the options that the values depend on
};

/// Names and values, without those that are empty: `software`, `package`, `package_manifest_xxh3`, `settings`.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> entries_of(const Provenance& provenance);

/// XXH3-64 of the bytes of a file, as 16 hexadecimal digits; empty where the file cannot be read.
[[nodiscard]] std::string xxh3_of_file(const std::filesystem::path& path);

}  // namespace farlod
