// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace farlod {

/// Packages of a few kilobytes of far maps of the kind `horizon`, and of the kind `box`. Files of their first blocks are changed.
[[nodiscard]] const std::array<std::filesystem::path, 2>& sample_packages();

[[nodiscard]] std::vector<std::byte> file_bytes(const std::filesystem::path& file);
[[nodiscard]] std::string file_text(const std::filesystem::path& file);

/// The header of a file of structs, once it is what no reader refuses: magic, version and length. Zeros for a file without one.
template <class Header>
Header mend_header(std::span<std::byte> bytes, const std::array<char, 8>& magic, std::uint32_t version) {
  Header header{};
  if (bytes.size() < sizeof header) return header;
  std::memcpy(&header, bytes.data(), sizeof header);
  header.magic = magic;
  header.version = version;
  header.file_bytes = bytes.size();
  std::memcpy(bytes.data(), &header, sizeof header);
  return header;
}
void mend_tiles(std::span<std::byte> tiles);

/// The manifest of a package without its checksum.
[[nodiscard]] nlohmann::json open_manifest(const std::filesystem::path& package);
/// How a manifest names a file: by its length and checksum.
[[nodiscard]] nlohmann::json entry_of_file(std::span<const std::byte> bytes);
void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes);
/// Writes the manifest with the checksum that it must have.
void write_sealed(const std::filesystem::path& package, std::string text);

/// Does the work. What the library promises to throw for a file that it refuses is no finding; a message is not empty.
void expect_answer_or_refusal(const std::function<void()>& work);

}  // namespace farlod
