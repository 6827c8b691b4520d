// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/file_stamp.hpp"

#include <xxhash.h>

#include <string>

#include "farlod/error.hpp"

namespace farlod {

void check_stamp(const std::filesystem::path& path, std::span<const std::byte> bytes, const package::FileStamp& stamp) {
  if (bytes.size() != stamp.bytes)
    throw PackageDamaged(path.string() + " is damaged: it has " + std::to_string(bytes.size()) + " bytes, the manifest says " +
                         std::to_string(stamp.bytes) + ". Copy it again, or pack the city again.");
  if (XXH3_64bits(bytes.data(), bytes.size()) != stamp.xxh3)
    throw PackageDamaged(path.string() +
                         " is damaged: its checksum is not the manifest's. Copy it again, or pack the city again.");
}

}  // namespace farlod
