// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_ingest.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  farlod::ingest_bytes({data, size}, ".stl", {});
  return 0;
}
