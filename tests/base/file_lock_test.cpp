// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/file_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace farlod
