// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/spool_file.hpp"

#include <gmock/gmock.h>

#include <string>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

std::uint64_t append(SpoolFile& file, const std::string& text) { return file.append(std::as_bytes(std::span(text))); }

std::string read(SpoolFile& file, std::uint64_t place, std::size_t size) {
  std::string text(size, ' ');
  file.read(place, std::as_writable_bytes(std::span(text)));
  return text;
}

TEST(SpoolFile, GivesBackWhatWaitsInAnyOrder) {
  const scenes::TemporaryFolder folder;
  SpoolFile file(folder.file("a.csv"));
  const auto first = append(file, "one"), second = append(file, "two"), nothing = append(file, "");
  EXPECT_EQ(read(file, second, 3), "two");
  EXPECT_EQ(read(file, nothing, 0), "");
  const auto third = append(file, "three");  // after reading elsewhere
  EXPECT_EQ(read(file, first, 3), "one");
  EXPECT_EQ(read(file, third, 5), "three");
}

TEST(SpoolFile, GoesWhenItsResultIsDone) {
  const scenes::TemporaryFolder folder;
  {
    SpoolFile file(folder.file("a.csv"));
    (void)append(file, "one");
    EXPECT_THAT(folder.names(), SizeIs(1));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(SpoolFile, SaysWhichResultItCannotWaitFor) {
  const scenes::TemporaryFolder folder;
  try {
    const SpoolFile file(folder.file("missing") / "a.csv");
    FAIL() << "a folder that does not exist was written to";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("missing/a.csv: No such file"));
  }
}

}  // namespace
}  // namespace farlod
