// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_package.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "tests/scenes/sealed_manifest.hpp"

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

void mend_tiles(std::span<std::byte> tiles) { (void)mend_header<package::Header>(tiles, package::magic, package::tiles_version); }

nlohmann::json open_manifest(const std::filesystem::path& package) {
  auto manifest = nlohmann::json::parse(file_text(package / package::manifest_file));
  manifest.erase("xxh3");
  return manifest;
}

nlohmann::json entry_of_file(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string seal = package::ManifestSeal::text_of(checksum_of_manifest(text));
  return {{"bytes", bytes.size()},
          {"xxh3", seal.substr(package::ManifestSeal::before_digits.size(), package::ManifestSeal::digits)}};
}

void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  FARLOD_EXPECTS(stream.flush());
}

void write_sealed(const std::filesystem::path& package, std::string text) {
  const std::string whole = scenes::sealed(std::move(text));
  write_bytes(package / package::manifest_file, std::as_bytes(std::span(whole)));
}

void expect_answer_or_refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& refusal) {
    FARLOD_EXPECTS(!std::string_view(refusal.what()).empty());
  }
}

}  // namespace farlod
