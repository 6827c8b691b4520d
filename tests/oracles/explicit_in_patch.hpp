// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "package/layout.hpp"
#include "package/receiver_patches.hpp"

namespace farlod {

/// Whether a far map stores an occluder as explicit for a patch (docs/package_format.md, "ExplicitOccluder").
[[nodiscard]] inline bool is_explicit_in(const package::ExplicitOccluder& occluder, const ReceiverPatches& patches,
                                         std::uint32_t patch) {
  const std::uint32_t square = patch % patches.squares(), layer = patch / patches.squares();
  return ((occluder.squares >> square) & 1U) != 0 && ((occluder.layers >> layer) & 1U) != 0;
}

}  // namespace farlod
