// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace farlod::scenes {

/// The path of a file or folder of the test data, which is no part of the project: real cities, and tables of papers. They lie in
/// the folder that the environment variable FARLOD_TEST_DATA names, or else in `shared/data` beside the project.
[[nodiscard]] inline std::filesystem::path test_data(const std::string& name) {
  const char* folder = std::getenv("FARLOD_TEST_DATA");
  return std::filesystem::path(folder != nullptr && *folder != '\0' ? folder : FARLOD_SHARED_DATA_DIR) / name;
}

/// What a test says that is skipped without this path.
[[nodiscard]] inline std::string absence_of(const std::filesystem::path& path) {
  return "no " + path.string() + ": FARLOD_TEST_DATA names the folder of the test data (CONTRIBUTING.md)";
}

}  // namespace farlod::scenes
