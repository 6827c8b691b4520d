// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace farlod {

/// Changes some elements of the sections of a `tiles.bin`, and now and then anything else. Returns how long it is then.
[[nodiscard]] std::size_t mutate_tiles(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed);

}  // namespace farlod
