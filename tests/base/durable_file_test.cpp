// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/durable_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DurableFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string text() const {
    std::ifstream file(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_.path()), {}); }

  scenes::TemporaryFolder folder_;
  fs::path file_ = folder_.file("file");
};

TEST_F(DurableFiles, HaveWhatWasWrittenAndReplaceWhatWasThere) {
  write_durably(file_, std::string_view("first"));
  write_durably(file_, std::string_view("second"));
  EXPECT_EQ(text(), "second");
  EXPECT_EQ(files(), 1);
}

TEST_F(DurableFiles, OfAWriterThatFailsLeaveTheOldOneAlone) {
  write_durably(file_, std::string_view("first"));
  const auto fail = [](const fs::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("no");
  };
  EXPECT_THROW(write_durably(file_, fail), std::runtime_error);
  EXPECT_EQ(text(), "first");
  EXPECT_EQ(files(), 1);
}

TEST_F(DurableFiles, ThatHaveNoRoomAreToldByName) {
  write_durably(file_, std::string_view("first"));
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit little { 1000, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &little);
  std::string said;
  try {
    write_durably(file_, std::string_view(std::string(5000, 'x')));
  } catch (const OutputError& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_THAT(said, HasSubstr(file_.string() + " cannot be written"));
  EXPECT_EQ(text(), "first");
  EXPECT_EQ(files(), 1);
}

TEST_F(DurableFiles, InNoFolderAreRefused) {
  EXPECT_THROW(write_durably(folder_.path() / "no" / "file", std::string_view("text")), OutputError);
}

TEST_F(DurableFiles, AreKnownByTheirNameWhileTheyAreWritten) {
  fs::path seen;
  write_durably(file_, [&](const fs::path& temporary) {
    seen = temporary;
    std::ofstream(temporary) << "text";
  });
  EXPECT_TRUE(is_unfinished_file(seen));
  EXPECT_FALSE(is_unfinished_file(file_));
  EXPECT_EQ(seen.parent_path(), file_.parent_path());
}

}  // namespace
}  // namespace farlod
