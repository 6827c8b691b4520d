// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "contract/package/layout.hpp"

namespace farlod {

/// A package that cannot be opened at all: it is not there, not a package, or of another version of the format (exit
/// code 3).
class PackageUnusable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A package that contradicts itself: truncated, altered, or written by a faulty program (exit code 4).
/// The message names the file and the first rule that it breaks.
class PackageDamaged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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
