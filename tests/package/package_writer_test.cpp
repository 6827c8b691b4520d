// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_writer.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "farlod/error.hpp"
#include "package/crown.hpp"
#include "package/crowns_of_city.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// A block of one empty cell.
class PackageWriting : public testing::Test {
 protected:
  PackageWriting() {
    grid_.cells = tiles_.cells = {0, 0, 1, 1};
    tiles_.tiles.resize(1);
    shape_.kind = "box";
    shape_.side_columns = shape_.rows = 4;
  }
  /// What the writer says of the block.
  std::string complaint() {
    return scenes::refusal_of<OutputError>([&] { (void)writer_.write_block(tiles_, BakedBoxes(1), grid_, {0, 0}, shape_); });
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
  EXPECT_EQ(complaint(), "no refusal");
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

Grid grid_of_six() {
  Grid grid;
  grid.cell_edge_m = 50.0;
  grid.cells = {0, 0, 3, 2};
  return grid;
}

CrownsOfCity three_crowns() {
  CrownsOfCity crowns(grid_of_six(), 10.0);
  crowns.add({110.0, 60.0}, 12.0, 20.0, 4.0, CrownShape::prism, Foliage::deciduous, 0.3);
  crowns.add({10.0, 20.0}, 11.0, 16.0, 3.0, CrownShape::spheroid, Foliage::unknown);
  crowns.add({105.0, 55.0}, 13.0, 19.0, 2.0, CrownShape::cylinder, Foliage::evergreen);
  return crowns;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
T read_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(WriteCanopy, WithoutCrownsThereIsNoFile) {
  const scenes::TemporaryFolder folder;
  CrownsOfCity none(grid_of_six(), 0.0);
  none.add({-1.0, 0.0}, 0.0, 1.0, 1.0, CrownShape::spheroid, Foliage::unknown);
  EXPECT_EQ(write_canopy(folder.path(), none), std::nullopt);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteCanopy, TheFileIsAsDocumented) {
  const scenes::TemporaryFolder folder;
  CrownsOfCity crowns = three_crowns();
  const auto canopy = write_canopy(folder.path() / "new", crowns);
  ASSERT_TRUE(canopy);
  const auto path = folder.path() / "new" / package::crowns_file;
  EXPECT_EQ(canopy->stamp, stamp_of(path));
  EXPECT_EQ(canopy->crowns_of_shape, (std::array<std::uint64_t, 3>{1, 1, 1}));
  const std::string bytes = text_of(path);
  ASSERT_EQ(bytes.size(), 64U + 2U * 32U + 3U * 24U);
  EXPECT_TRUE(bytes.starts_with("FARLODC\n"));
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 8), 1U);
  EXPECT_EQ(read_at<float>(bytes, 12), 4.0F);
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 16), 2U);
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 24), 3U);
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 32), bytes.size());
  EXPECT_EQ(bytes.substr(40, 24), std::string(24, '\0'));
  const auto cell = read_at<package::CrownCellRecord>(bytes, 96);
  EXPECT_EQ(cell.i, 2);
  EXPECT_EQ(cell.j, 1);
  EXPECT_EQ(cell.first_crown, 1U);
  EXPECT_EQ(cell.crown_count, 2U);
  EXPECT_EQ(cell.z_low_m, 2.0F);
  EXPECT_EQ(cell.z_high_m, 10.0F);
  EXPECT_EQ(read_at<Crown>(bytes, 128), (Crown{10.0F, 20.0F, 1.0F, 6.0F, 3.0F, CrownShape::spheroid, Foliage::unknown, 0}));
  EXPECT_EQ(read_at<Crown>(bytes, 152), (Crown{5.0F, 5.0F, 3.0F, 9.0F, 2.0F, CrownShape::cylinder, Foliage::evergreen, 0}));
  EXPECT_EQ(read_at<Crown>(bytes, 176).turn, std::lround(0.3 / (std::numbers::pi / 2.0) * 65536.0));
}

TEST(WriteCanopy, AFolderThatCannotBeMadeIsAnOutputError) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  CrownsOfCity crowns = three_crowns();
  EXPECT_THROW((void)write_canopy(folder.path() / "file", crowns), OutputError);
}

TEST(WriteCanopy, APackageWithCrownsMayBeReplaced) {
  const scenes::TemporaryFolder folder;
  CrownsOfCity crowns = three_crowns();
  ASSERT_TRUE(write_canopy(folder.path() / "a.farlod", crowns));
  EXPECT_NO_THROW(require_replaceable(folder.path() / "a.farlod"));
  std::ofstream(folder.path() / "a.farlod" / "crowns.txt") << "of somebody else";
  EXPECT_THROW(require_replaceable(folder.path() / "a.farlod"), OutputError);
}

TEST(Manifest, CountsCrownsWhereThereAreSome) {
  package::Manifest manifest;
  manifest.grid = grid_of_six();
  manifest.far_map.kind = "box";
  EXPECT_THAT(manifest_text(manifest), Not(HasSubstr("canopy")));
  manifest.canopy = package::CanopyFile{{77, 0xABC}, {1, 2, 3}};
  EXPECT_THAT(manifest_text(manifest),
              HasSubstr("\"canopy\": {\n  \"bytes\": 77,\n  \"xxh3\": \"0000000000000abc\",\n  \"spheroids\": 1,\n"
                        "  \"cylinders\": 2,\n  \"prisms\": 3\n }"));
}

}  // namespace
}  // namespace farlod
