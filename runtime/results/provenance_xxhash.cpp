// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>

#include "results/provenance.hpp"

namespace farlod {

std::vector<std::pair<std::string, std::string>> entries_of(const Provenance& provenance) {
  std::vector<std::pair<std::string, std::string>> entries;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) entries.emplace_back(name, value);
  };
  add("software", provenance.software);
  add("package", provenance.package);
  add("package_manifest_xxh3", provenance.manifest_xxh3);
  add("settings", provenance.settings);
  return entries;
}

std::string xxh3_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (!file || state == nullptr) return {};
  XXH3_64bits_reset(state.get());
  std::array<char, 65536> bytes{};
  while (file) {
    file.read(bytes.data(), bytes.size());
    XXH3_64bits_update(state.get(), bytes.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) return {};
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(XXH3_64bits_digest(state.get())));
  return digits.data();
}

}  // namespace farlod
