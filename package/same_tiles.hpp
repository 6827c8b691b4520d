// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace farlod {

/// Whether a block's `tiles.bin` holds the same tiles as another one that has no far maps. Far maps are not compared: neither the
/// sections of the kind `horizon`, nor the fields of a cell of the kind `box`.
[[nodiscard]] bool same_tiles(std::span<const std::byte> file, std::span<const std::byte> file_without_maps);

}  // namespace farlod
