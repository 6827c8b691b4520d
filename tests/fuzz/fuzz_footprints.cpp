// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_ingest.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  farlod::ingest::IngestSettings settings;
  settings.footprints.default_height_m = 10.0;
  // With this ending our own reader refuses what is no JSON, before GDAL tries all of its formats on it
  farlod::ingest_bytes(bytes, ".json", settings);
  settings.footprints.base_field = "base";
  farlod::ingest_bytes(bytes, ".json", settings);
  return 0;
}
