// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace farlod {

/// Measures how much memory is held at a time from its construction on, beyond what was held before: all that this program and
/// its libraries take with `new` and malloc.
class HeldMemory {
 public:
  HeldMemory();
  [[nodiscard]] std::size_t most_bytes() const;
  /// What is held now, of all that the process has taken.
  [[nodiscard]] static std::size_t now_bytes();

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static constexpr bool counts_malloc = false;  ///< malloc is the sanitizer's: what libraries of C take is not seen
#else
  static constexpr bool counts_malloc = true;
#endif

 private:
  std::size_t before_;
};

}  // namespace farlod
