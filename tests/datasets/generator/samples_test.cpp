// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <string>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

const fs::path datasets = fs::path(FARLOD_SOURCE_DIR) / "datasets";

/// The commands of the README's table, by the name of the sample that they make.
std::map<std::string, std::string> commands() {
  const std::string readme = scenes::text_of(datasets / "README.md");
  const std::regex command("`farlod-city (-o samples/([^ `]+)[^`]*)`");
  std::map<std::string, std::string> result;
  for (std::sregex_iterator m(readme.begin(), readme.end(), command), end; m != end; ++m) result[(*m)[2]] = (*m)[1];
  return result;
}

TEST(Samples, EachFileHasItsCommandAndEachCommandItsFile) {
  std::map<std::string, std::string> rows = commands();
  for (const auto& entry : fs::directory_iterator(datasets / "samples"))
    EXPECT_EQ(rows.erase(entry.path().filename().string()), 1U) << entry.path().filename();
  for (const auto& [name, arguments] : rows) ADD_FAILURE() << name << " is in the README and not there";
}

TEST(Samples, AreSmall) {
  for (const auto& entry : fs::directory_iterator(datasets / "samples")) EXPECT_LT(entry.file_size(), 150'000U) << entry.path();
}

TEST(Samples, EachIsMadeAgainToTheByte) {
  const scenes::TemporaryFolder folder;
  fs::create_directory(folder.file("samples"));
  ASSERT_FALSE(commands().empty());
  for (const auto& [name, arguments] : commands()) {
    const std::string line =
        "cd '" + folder.path().string() + "' && '" + std::string(FARLOD_BIN_DIR) + "/farlod-city' --quiet " + arguments;
    ASSERT_EQ(std::system(line.c_str()), 0) << line;
    EXPECT_TRUE(scenes::text_of(folder.file("samples") / name) == scenes::text_of(datasets / "samples" / name))
        << name << " differs: if the generator was meant to change, run the README's commands in datasets/";
  }
}

}  // namespace
}  // namespace farlod
