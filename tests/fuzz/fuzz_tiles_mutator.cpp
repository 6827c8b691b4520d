// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/tiles_mutator.hpp"

/// The name that libFuzzer calls.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  return farlod::mutate_tiles(data, size, max_size, seed);
}
