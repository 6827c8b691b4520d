// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace farlod {
namespace {

/// Names of the files that a format's fuzzer begins with, and of its old findings.
std::vector<std::string> corpus() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(FARLOD_CORPUS_DIR))
    files.push_back(entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class Corpus : public testing::TestWithParam<std::string> {};

/// Old findings stay mended: a file that the reader stumbles over aborts, or throws what is no InputError.
TEST_P(Corpus, IsReadOrRefused) {
  std::ifstream stream(std::filesystem::path(FARLOD_CORPUS_DIR) / GetParam(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
}

INSTANTIATE_TEST_SUITE_P(Each, Corpus, testing::ValuesIn(corpus()), name_of);

TEST(CorpusFolder, IsNotEmpty) { EXPECT_FALSE(corpus().empty()); }

}  // namespace
}  // namespace farlod
