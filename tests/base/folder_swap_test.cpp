// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/folder_swap.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

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
