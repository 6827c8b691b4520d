// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_package.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/layout.hpp"

namespace farlod {

const std::array<std::filesystem::path, 2>& sample_packages() {
  static const std::filesystem::path golden = FARLOD_GOLDEN_DIR;
  static const std::array<std::filesystem::path, 2> samples{golden / "version_8_horizon.farlod", golden / "version_8_box.farlod"};
  return samples;
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  FARLOD_EXPECTS(stream);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::byte> file_bytes(const std::filesystem::path& file) {
  const std::string text = file_text(file);
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void mend_header(std::span<std::byte> tiles) {
  if (tiles.size() < sizeof(package::Header)) return;
  package::Header header{};
  std::memcpy(&header, tiles.data(), sizeof header);
  header.magic = package::magic;
  header.version = package::tiles_version;
  header.file_bytes = tiles.size();
  std::memcpy(tiles.data(), &header, sizeof header);
}

void expect_answer_or_refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& refusal) {
    FARLOD_EXPECTS(!std::string_view(refusal.what()).empty());
  }
}

}  // namespace farlod
