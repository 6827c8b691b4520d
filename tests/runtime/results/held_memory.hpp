// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace farlod {

/// Measures how much memory is held at a time from its construction on, beyond what was held before. It counts what this
/// program and the libraries of C++ take with `new`, and not what a library of C takes with malloc.
class HeldMemory {
 public:
  HeldMemory();
  [[nodiscard]] std::size_t most_bytes() const;

 private:
  std::size_t before_;
};

}  // namespace farlod
