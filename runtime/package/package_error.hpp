// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "contract/package/layout.hpp"
#include "farlod/error.hpp"

namespace farlod {

/// A file of a package whose version this program does not read is unusable; one of version 0, which never was, is damaged.
inline void require_readable_version(const std::string& file, std::uint32_t version) {
  if (version == package::format_version) return;
  if (version == 0) throw PackageDamaged(file + " is damaged: its format version does not exist. Pack the city again.");
  const bool is_newer = version > package::format_version;
  throw PackageUnusable(
      file + " has format version " + std::to_string(version) + ", this program reads version " +
      std::to_string(package::format_version) + ". " +
      (is_newer ? "Use a newer farlod-svf, or pack the city again." : "Pack the city again with this release."));
}

}  // namespace farlod
