// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "farlod/error.hpp"
#include "package/layout.hpp"

namespace farlod {

/// A file of a package whose version this program does not read is unusable; one of version 0, which never was, is damaged.
/// Versions from `oldest` to `newest` are read.
inline void require_readable_version(const std::string& file, std::uint32_t version, std::uint32_t oldest, std::uint32_t newest) {
  if (oldest <= version && version <= newest) return;
  if (version == 0) throw PackageDamaged(file + " is damaged: its format version does not exist. Pack the city again.");
  const std::string readable = oldest == newest ? "version " + std::to_string(newest)
                                                : "versions " + std::to_string(oldest) + " to " + std::to_string(newest);
  throw PackageUnusable(
      file + " has format version " + std::to_string(version) + ", this program reads " + readable + ". " +
      (version > newest ? "Use a newer release, or pack the city again." : "Pack the city again with this release."));
}

}  // namespace farlod
