// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/atomic_file.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(AtomicFile, AppearsUnderItsNameOnly) {
  const scenes::TemporaryFolder folder;
  write_atomically(folder.file("a.csv"), [&folder](std::ostream& out) {
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv")));
    out << "whole";
  });
  EXPECT_THAT(folder.names(), ElementsAre("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")), "whole");
}

TEST(AtomicFile, ReplacesAnOlderFile) {
  const scenes::TemporaryFolder folder;
  for (const char* text : {"older and longer", "new"})
    write_atomically(folder.file("a.csv"), [text](std::ostream& out) { out << text; });
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")), "new");
}

TEST(AtomicFile, LeavesNothingBehindWhenTheWriterFails) {
  const scenes::TemporaryFolder folder;
  const auto fail = [](std::ostream& out) {
    out << "half of it";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(write_atomically(folder.file("a.csv"), fail), std::runtime_error);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, LeavesNothingBehindWhenTheDiskRefuses) {
  const scenes::TemporaryFolder folder;
  const auto refuse = [](std::ostream& out) { out.setstate(std::ios::badbit); };
  EXPECT_THROW(write_atomically(folder.file("a.csv"), refuse), OutputError);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, LeavesNothingBehindWhenTheNameIsTaken) {
  const scenes::TemporaryFolder folder;
  std::filesystem::create_directories(folder.file("a.csv") / "inside");
  EXPECT_THROW(write_atomically(folder.file("a.csv"), [](std::ostream& out) { out << "x"; }), OutputError);
  EXPECT_THAT(folder.names(), ElementsAre("a.csv"));
}

TEST(AtomicFile, NamesTheFileAndTheReason) {
  const scenes::TemporaryFolder folder;
  try {
    write_atomically(folder.file("missing") / "a.csv", [](std::ostream& out) { out << "x"; });
    FAIL() << "a folder that does not exist was written to";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing/a.csv: No such file or directory"));
  }
}

}  // namespace
}  // namespace farlod
