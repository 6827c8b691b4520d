// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace farlod {

/// A package that cannot be opened at all: it is not there, not a package, or of a newer format (exit code 3).
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

}  // namespace farlod
