// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/changed_file.hpp"
#include "tests/fuzz/tiles_mutator.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// The name that libFuzzer calls. The first byte says which file the others are.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  using namespace farlod;
  if (size < 2) return LLVMFuzzerMutate(data, size, max_size);
  return ChangedFile::of(data[0]).kind == ChangedFile::Kind::tiles ? 1 + mutate_tiles(data + 1, size - 1, max_size - 1, seed)
                                                                   : 1 + LLVMFuzzerMutate(data + 1, size - 1, max_size - 1);
}
