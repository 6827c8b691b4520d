// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <ostream>

#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

/// What stands between two fences, in the order of the page.
std::vector<std::string> fenced_blocks(const std::filesystem::path& page) {
  std::ifstream file(page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> blocks;
  bool inside = false;
  for (const std::string& line : lines_of(text)) {
    if (line == "```") {
      inside = !inside;
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

bool is_command(const std::string& block) {
  return block.starts_with("build/bin/") || block.starts_with("awk ") || block.starts_with("gzip ");
}

struct Tutorial {
  const char* page;
  std::size_t commands;
  std::vector<const char*> tables;  ///< that its commands write, and that it shows
};
void PrintTo(const Tutorial& tutorial, std::ostream* out) { *out << tutorial.page; }

class Tutorials : public testing::TestWithParam<Tutorial> {};

TEST_P(Tutorials, SayWhatTheProgramsSay) {
  const WorkFolder folder;
  folder.must(std::string("ln -s '") + FARLOD_SOURCE_DIR + "/datasets' datasets && mkdir build && ln -s '" + FARLOD_BIN_DIR +
              "' build/bin");
  std::string said;
  std::size_t commands = 0;
  for (const std::string& block : fenced_blocks(std::filesystem::path(FARLOD_SOURCE_DIR) / "docs/tutorials" / GetParam().page)) {
    if (is_command(block)) {
      const Outcome outcome = folder.run(block);
      ASSERT_EQ(outcome.exit_code, 0) << block << outcome.err;
      said = outcome.out;
      for (const char* table : GetParam().tables) said += folder.text_of(table);
      ++commands;
      continue;
    }
    for (const std::string& line : lines_of(block)) EXPECT_THAT(said, testing::HasSubstr(line));
  }
  EXPECT_EQ(commands, GetParam().commands);
}

INSTANTIATE_TEST_SUITE_P(All, Tutorials,
                         testing::Values(Tutorial{"city_files.md", 5, {}}, Tutorial{"trees.md", 8, {}},
                                         Tutorial{
                                             "facades.md", 3, {"facades.csv", "facades.surfaces.csv", "facades.buildings.csv"}}));

}  // namespace
}  // namespace farlod::acceptance
