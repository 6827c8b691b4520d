// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "package/layout.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A block of one empty cell.
class PackageWriting : public testing::Test {
 protected:
  PackageWriting() {
    grid_.cells = tiles_.cells = {0, 0, 1, 1};
    tiles_.tiles.resize(1);
    shape_.kind = "box";
    shape_.side_columns = shape_.rows = 4;
  }
  /// What the writer says of the block; nothing when it is written.
  std::string complaint() {
    try {
      (void)writer_.write_block(tiles_, BakedBoxes(1), grid_, {0, 0}, shape_);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] fs::path block() const { return package_ / package::block_folder({0, 0}); }

  scenes::TemporaryFolder folder_;
  fs::path package_ = folder_.path() / "town.farlod";
  PackageWriter writer_{package_};
  Grid grid_;
  TileSet tiles_;
  package::FarMapShape shape_;
};

TEST_F(PackageWriting, WritesTwoFilesAndLeavesNoOther) {
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(fs::is_regular_file(block() / package::tiles_file));
  EXPECT_TRUE(fs::is_regular_file(block() / package::far_map_file));
  EXPECT_EQ(std::distance(fs::directory_iterator(block()), {}), 2);
}

// What the file system refuses is no fault of ours: each must be a OutputError that names the file

TEST_F(PackageWriting, SaysThatAFarMapCannotBeWritten) {
  fs::create_directories(block() / (std::string(package::far_map_file) + ".part"));
  EXPECT_THAT(complaint(), HasSubstr("far.exr"));
}

TEST_F(PackageWriting, SaysThatAFileCannotBePutInItsPlace) {
  for (const char* name : {package::tiles_file, package::far_map_file}) {
    fs::create_directories(block() / name);
    EXPECT_THAT(complaint(), HasSubstr(name));
    fs::remove(block() / name);
  }
}

TEST_F(PackageWriting, SaysThatAFolderCannotBeMade) {
  fs::create_directories(block().parent_path());
  std::ofstream(block()) << "a file";
  EXPECT_THAT(complaint(), HasSubstr(block().string()));
}

}  // namespace
}  // namespace farlod
