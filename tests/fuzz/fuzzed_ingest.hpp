// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "ingest/ingest.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace farlod {

/// A file with these bytes, which the next call replaces.
[[nodiscard]] std::filesystem::path write_file(std::span<const std::uint8_t> bytes, std::string_view ending);

/// Has `bytes` read as a file whose name ends with `ending`. Either InputError refuses the file, with a message, or the city
/// keeps the promises of ingest.hpp: a breach aborts. Any other exception is passed on.
void ingest_bytes(std::span<const std::uint8_t> bytes, std::string_view ending, const ingest::IngestSettings& settings);

}  // namespace farlod
