// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A package that opens, or one line that says why there is none.
void expect_package_or_one_clear_error(const WorkFolder& folder, const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  // Each takes a second or less. What has not ended by then never will, however busy the machine is
  const Outcome outcome = folder.run("timeout 600 farlod-pack " + file + " " + options + " -o a.farlod --force --quiet");
  if (outcome.exit_code == exit_done) {
    EXPECT_EQ(outcome.err, "");
    return folder.must("farlod-svf a.farlod -o a.asc --grid 5 --quiet");
  }
  EXPECT_EQ(outcome.exit_code, exit_unusable_input) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_EQ(lines.size(), 1U) << outcome.err;
  EXPECT_THAT(lines.front(), testing::StartsWith("farlod-pack: "));
  EXPECT_THAT(lines.front(), testing::HasSubstr(std::filesystem::path(file).filename().string()));
}

class StrangeFiles : public RealCity, public testing::WithParamInterface<const char*> {};

TEST_P(StrangeFiles, GiveAPackageOrOneClearError) {
  needs({GetParam()});
  if (IsSkipped()) return;
  const std::vector<std::string> files = files_in(data(GetParam()));
  EXPECT_GT(files.size(), 5U);
  for (const std::string& file : files) {
    expect_package_or_one_clear_error(folder, file, "");
    expect_package_or_one_clear_error(folder, file, "--crs EPSG:25832 --default-height 10");
  }
}

INSTANTIATE_TEST_SUITE_P(Folders, StrangeFiles, testing::Values("formats", "broken"));

}  // namespace
}  // namespace farlod::acceptance
