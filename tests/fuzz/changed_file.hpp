// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace farlod {

/// Which file of which sample package an input of fuzz_package replaces: its first byte says so.
struct ChangedFile {
  enum class Kind : std::uint8_t { manifest, tiles, far_map };
  std::size_t package = 0;  ///< in sample_packages()
  Kind kind = Kind::manifest;

  [[nodiscard]] static ChangedFile of(std::uint8_t first) { return {first % 2U, static_cast<Kind>(first / 2U % 3U)}; }
};

}  // namespace farlod
