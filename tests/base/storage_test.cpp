// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/durable_file.hpp"
#include "base/file_lock.hpp"
#include "base/folder_swap.hpp"
#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

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

class FileLocks : public testing::Test {
 protected:
  scenes::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.file("lock");
};

TEST_F(FileLocks, AnExclusiveOneKeepsAllOthersOff) {
  const auto held = FileLock::try_lock(file_, LockKind::exclusive);
  ASSERT_TRUE(held);
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::exclusive));
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::shared));
  EXPECT_FALSE(FileLock::try_lock_existing(file_, LockKind::shared));
}

TEST_F(FileLocks, SharedOnesKeepExclusiveOnesOff) {
  auto first = FileLock::try_lock(file_, LockKind::shared);
  auto second = FileLock::try_lock_existing(file_, LockKind::shared);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::exclusive));
  first.reset();
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::exclusive));
  second.reset();
  EXPECT_TRUE(FileLock::try_lock(file_, LockKind::exclusive));
}

TEST_F(FileLocks, AreMovedAndEndOnce) {
  std::optional<FileLock> moved;
  {
    auto held = FileLock::try_lock(file_, LockKind::exclusive);
    moved = std::move(held);
  }
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::exclusive));
  moved.reset();
  EXPECT_TRUE(FileLock::try_lock(file_, LockKind::exclusive));
}

TEST_F(FileLocks, EndWithAProcessThatIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    const auto held = FileLock::try_lock(file_, LockKind::exclusive);
    held->sign("waiting");
    pause();
    _exit(0);
  }
  while (holder_of(file_).empty()) usleep(1000);
  EXPECT_THAT(holder_of(file_), HasSubstr("waiting, process " + std::to_string(child)));
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::exclusive));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(FileLock::try_lock(file_, LockKind::exclusive));
}

/// Who finishes removes the file: the next one must not hold a lock on a file that nobody else can see.
TEST_F(FileLocks, AreOnTheFileThatHasTheName) {
  auto held = FileLock::try_lock(file_, LockKind::exclusive);
  std::filesystem::remove(file_);
  const auto other = FileLock::try_lock(file_, LockKind::exclusive);
  EXPECT_TRUE(other);
  EXPECT_TRUE(std::filesystem::exists(file_));
  held.reset();
  EXPECT_FALSE(FileLock::try_lock(file_, LockKind::shared));
}

TEST_F(FileLocks, OnWhatIsNotThereAreNone) {
  EXPECT_FALSE(FileLock::try_lock_existing(folder_.file("lost"), LockKind::shared));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("lost")));
  EXPECT_THROW((void)FileLock::try_lock(folder_.path() / "no" / "folder", LockKind::shared), OutputError);
}

class FolderSwap : public testing::Test {
 protected:
  FolderSwap() {
    for (const fs::path& f : {here_, there_}) fs::create_directory(f);
    std::ofstream(here_ / "new") << "new";
    std::ofstream(there_ / "old") << "old";
  }
  scenes::TemporaryFolder folder_;
  fs::path here_ = folder_.file("here"), there_ = folder_.file("there"), aside_ = folder_.file("aside");
};

TEST_F(FolderSwap, GivesEachTheNameOfTheOther) {
  swap_folders(here_, there_, aside_);
  EXPECT_TRUE(fs::exists(there_ / "new"));
  EXPECT_TRUE(fs::exists(here_ / "old"));
  EXPECT_FALSE(fs::exists(aside_));
}

TEST_F(FolderSwap, OfWhatIsNotThereChangesNothing) {
  fs::remove_all(here_);
  EXPECT_THROW(swap_folders(here_, there_, aside_), OutputError);
  EXPECT_TRUE(fs::exists(there_ / "old"));
}

TEST_F(FolderSwap, MovesAFolderToANewName) {
  move_folder(here_, aside_);
  EXPECT_TRUE(fs::exists(aside_ / "new"));
  EXPECT_THROW(move_folder(here_, folder_.path() / "no" / "folder"), OutputError);
}

}  // namespace
}  // namespace farlod
