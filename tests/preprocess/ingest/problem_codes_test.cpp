// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>
#include <map>

#include "reading.hpp"

namespace farlod::test {
namespace {

namespace fs = std::filesystem;

/// The codes that this stage can report; another stage adds a test like this with its own hundred.
bool is_of_ingest(int code) { return code / 100 == 1; }

std::map<int, std::string> described() {
  std::map<int, std::string> codes;
  for (const ProblemDescription& d : problem_descriptions)
    if (is_of_ingest(static_cast<int>(d.code))) codes[static_cast<int>(d.code)] = d.slug;
  return codes;
}

/// "104_ring_not_closed.gml" → 104, ring_not_closed
std::map<int, std::string> fixtures() {
  std::map<int, std::string> codes;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(FARLOD_SOURCE_DIR) / "datasets/broken")) {
    const std::string name = entry.path().filename().string();
    const int code = std::atoi(name.c_str());
    if (is_of_ingest(code)) codes[code] = name.substr(4, name.find('.') - 4);
  }
  return codes;
}

/// "### 104 ring_not_closed" → 104, ring_not_closed
std::map<int, std::string> documented() {
  std::map<int, std::string> codes;
  std::ifstream page(fs::path(FARLOD_SOURCE_DIR) / "docs/problems.md");
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("### ") && is_of_ingest(std::atoi(line.c_str() + 4)))
      codes[std::atoi(line.c_str() + 4)] = line.substr(8);
  return codes;
}

TEST(ProblemCodes, EachHasAFixture) { EXPECT_EQ(described(), fixtures()); }

TEST(ProblemCodes, EachHasAParagraph) { EXPECT_EQ(described(), documented()); }

TEST(ProblemCodes, EachFixtureHasExactlyItsProblem) {
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(FARLOD_SOURCE_DIR) / "datasets/broken")) {
    const int code = std::atoi(entry.path().filename().c_str());
    if (!is_of_ingest(code)) continue;
    ++files;
    const Reading r = read_file(entry.path());
    EXPECT_EQ(r.codes(), std::set<int>{code}) << entry.path();
    EXPECT_EQ(r.report.problems().size(), 1u) << entry.path();
    EXPECT_EQ(r.city().buildings()[0].facet_count, 6u) << entry.path() << ": the good house must survive";
  }
  EXPECT_EQ(files, described().size());
}

}  // namespace
}  // namespace farlod::test
