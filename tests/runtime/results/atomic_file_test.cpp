// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/atomic_file.hpp"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>

#include "farlod/error.hpp"
#include "results/spool_file.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

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
  EXPECT_THAT(scenes::refusal_of<OutputError>(
                  [&] { write_atomically(folder.file("missing") / "a.csv", [](std::ostream& out) { out << "x"; }); }),
              HasSubstr("missing/a.csv: No such file or directory"));
}

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
  EXPECT_THAT(scenes::refusal_of<OutputError>([&] { const SpoolFile file(folder.file("missing") / "a.csv"); }),
              testing::HasSubstr("missing/a.csv: No such file"));
}

}  // namespace
}  // namespace farlod
