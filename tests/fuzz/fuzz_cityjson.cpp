// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_ingest.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  farlod::ingest_bytes(bytes, ".city.json", {});
  // LoD 0 is raised to prisms, and only where one asks for it
  farlod::ingest::IngestSettings footprints;
  footprints.lod.exactly = 0;
  farlod::ingest_bytes(bytes, ".city.json", footprints);
  return 0;
}
