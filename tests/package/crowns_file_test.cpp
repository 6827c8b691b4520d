// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/crowns_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "package/file_stamp.hpp"
#include "package/manifest.hpp"
#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/planted_crowns.hpp"

namespace farlod {
namespace {

using namespace package;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// The small package with trees in two of its three cells: two spheroids and a prism in (0, 0), a cylinder in (2, 0).
class SmallPark : public testing::Test {
 protected:
  SmallPark() {
    CrownsOfCity crowns = scenes::crowns_for(small.folder());
    crowns.add({45.0, 15.0}, 3.0, 9.0, 2.0, CrownShape::cylinder, Foliage::deciduous);
    crowns.add({10.0, 11.0}, 2.0, 8.0, 3.0, CrownShape::spheroid, Foliage::unknown);
    crowns.add({12.0, 1.0}, 4.0, 7.0, 1.5, CrownShape::prism, Foliage::evergreen, 0.5);
    crowns.add({5.0, 11.0}, 1.0, 6.0, 2.5, CrownShape::spheroid, Foliage::deciduous);
    scenes::plant(crowns, small.folder());
    whole = bytes_of(path());
  }
  [[nodiscard]] std::filesystem::path path() const { return small.folder() / crowns_file; }

  /// What a reader says of other bytes, whose size and checksum are in the manifest.
  [[nodiscard]] std::string damage_of(const Bytes& bytes) const {
    write_bytes(path(), bytes);
    Manifest manifest = read_manifest(small.folder());
    manifest.canopy->stamp = stamp_of(path());
    return damage_met_by([&] { (void)CrownsFile(PackageFolder(small.folder()), manifest); });
  }
  /// The same of a number that is another one.
  template <class T>
  [[nodiscard]] std::string damage_with(std::size_t offset, T value) const {
    Bytes bytes = whole;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return damage_of(bytes);
  }
  [[nodiscard]] std::string damage_of(const json& manifest) const {
    small.write_manifest(manifest);
    return damage_met_by([&] { (void)PackageReader(small.folder()); });
  }
  template <class T>
  [[nodiscard]] T number_at(std::size_t offset) const {
    T value;
    std::memcpy(&value, whole.data() + offset, sizeof value);
    return value;
  }

  static constexpr std::size_t first_cell = sizeof(CrownsHeader), second_cell = first_cell + sizeof(CrownCellRecord),
                               crowns_begin = second_cell + sizeof(CrownCellRecord);
  static constexpr std::size_t crown(std::size_t n, std::size_t field) { return crowns_begin + n * sizeof(Crown) + field; }
  static constexpr float infinity = std::numeric_limits<float>::infinity(), no_number = std::numeric_limits<float>::quiet_NaN();

  SmallPackage small;
  Bytes whole;
};

TEST_F(SmallPark, CrownsComeBackCellByCell) {
  const PackageReader package(small.folder());
  ASSERT_TRUE(package.has_crowns());
  EXPECT_EQ(package.manifest().version, format_version);
  EXPECT_EQ(package.manifest().canopy->crowns_of_shape, (std::array<std::uint64_t, 3>{2, 1, 1}));
  const auto low_m = static_cast<float>(package.manifest().height_origin_m);
  const auto first = package.crowns_of({0, 0});
  ASSERT_EQ(first.size(), 3U);
  EXPECT_EQ(first[0].shape, CrownShape::prism);
  EXPECT_NEAR(first[0].turn_rad(), 0.5, std::numbers::pi / 2.0 / 65536.0);
  EXPECT_EQ(first[1], (Crown{5.0F, 11.0F, 1.0F - low_m, 6.0F - low_m, 2.5F, CrownShape::spheroid, Foliage::deciduous, 0}));
  EXPECT_EQ(first[2], (Crown{10.0F, 11.0F, 2.0F - low_m, 8.0F - low_m, 3.0F, CrownShape::spheroid, Foliage::unknown, 0}));
  EXPECT_TRUE(package.crowns_of({1, 0}).empty());
  ASSERT_EQ(package.crowns_of({2, 0}).size(), 1U);
  EXPECT_EQ(package.crowns_of({2, 0})[0].x_m, 5.0F);
  EXPECT_EQ(package.crowns().largest_half_width_m(), 3.0F);
}

TEST(PackageWithoutTrees, HasNoCrowns) {
  const SmallPackage small;
  const PackageReader package(small.folder());
  EXPECT_FALSE(package.has_crowns());
  EXPECT_EQ(package.manifest().version, format_version);
  EXPECT_TRUE(package.crowns_of({0, 0}).empty());
}

TEST(PackageWithoutTrees, KeepsItsVersionAndItsFiles) {
  const SmallPackage small;
  json before = small.manifest();
  before["inputs"] = json::array();
  small.write_manifest(before);
  CrownsOfCity none = scenes::crowns_for(small.folder());
  scenes::plant(none, small.folder());
  EXPECT_EQ(small.manifest(), before);
  EXPECT_FALSE(std::filesystem::exists(small.folder() / crowns_file));
}

TEST_F(SmallPark, AManifestSaysWhatTheVersionDemands) {
  const json right = small.manifest();
  EXPECT_EQ(damage_of(right), "no damage");
  json m = right;
  m.erase("canopy");
  EXPECT_EQ(damage_of(m), "no damage");
  m["version"] = canopy_format_version;
  EXPECT_THAT(damage_of(m), HasSubstr("canopy"));
  m = right;
  for (const char* key : crown_shape_keys) m["canopy"][key] = 0;
  EXPECT_THAT(damage_of(m), HasSubstr("it names crowns, and counts none"));
  m = right;
  m["canopy"]["prisms"] = std::uint64_t{1} << 63;
  EXPECT_THAT(damage_of(m), HasSubstr("its number of crowns is impossible"));
  m["canopy"]["prisms"] = 1.5;
  EXPECT_THAT(damage_of(m), HasSubstr("a whole number was expected"));
  // A key that version 8 does not know
  m = right;
  m["version"] = 8;
  EXPECT_EQ(damage_of(m), "no damage");
  EXPECT_FALSE(PackageReader(small.folder()).has_crowns());
  m["version"] = newest_format_version + 1;
  small.write_manifest(m);
  EXPECT_THROW((void)PackageReader(small.folder()), PackageUnusable);
}

TEST_F(SmallPark, FilesThatAreNotTheManifestsAreRefused) {
  const auto damage = [&] { return damage_met_by([&] { (void)PackageReader(small.folder()).crowns(); }); };
  EXPECT_EQ(damage(), "no damage");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    Bytes bytes = whole;
    bytes[n] ^= std::byte{1};
    write_bytes(path(), bytes);
    EXPECT_THAT(damage(), AllOf(HasSubstr(path().string()), HasSubstr("its checksum is not the manifest's"))) << n;
  }
  write_bytes(path(), std::span(whole).first(whole.size() - 1));
  EXPECT_THAT(damage(), HasSubstr("bytes, the manifest says"));
  std::filesystem::remove(path());
  EXPECT_THAT(damage(), HasSubstr(path().string()));
  std::filesystem::create_directory(path());
  EXPECT_THAT(damage(), HasSubstr("is not a file"));
  std::filesystem::remove(path());
  write_bytes(small.folder() / "elsewhere", whole);
  std::filesystem::create_symlink("elsewhere", path());
  EXPECT_THAT(damage(), HasSubstr("is a link"));
}

TEST_F(SmallPark, AFileThatIsReplacedWhileItIsOpenIsTold) {
  const PackageReader package(small.folder());
  write_bytes(path(), whole);
  package.require_unchanged();
  (void)package.crowns();
  package.require_unchanged();
  std::filesystem::remove(path());
  EXPECT_THAT(damage_met_by([&] { package.require_unchanged(); }), HasSubstr(crowns_file));
}

TEST_F(SmallPark, EachRuleOfTheHeaderIsChecked) {
  EXPECT_EQ(damage_of(whole), "no damage");
  EXPECT_THAT(damage_with(0, 'G'), HasSubstr("it does not begin as crowns.bin does"));
  EXPECT_THAT(damage_with(8, std::uint32_t{0}), HasSubstr("its format version does not exist"));
  EXPECT_THROW((void)damage_with(8, std::uint32_t{2}), PackageUnusable);
  EXPECT_THAT(damage_with(12, 4.0F), HasSubstr("its largest half width is not that of its crowns"));
  EXPECT_THAT(damage_with(12, no_number), HasSubstr("its largest half width is not that of its crowns"));
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{5}, ~std::uint64_t{0}})
    EXPECT_THAT(damage_with(16, count), HasSubstr("its numbers of crowns are impossible")) << count;
  EXPECT_THAT(damage_with(16, std::uint64_t{1}), HasSubstr("its length is not that of its crowns"));
  EXPECT_THAT(damage_with(24, ~std::uint64_t{0}), HasSubstr("its numbers of crowns are impossible"));
  // 24 · 2⁶¹ is 0 in 64 bits
  EXPECT_THAT(damage_with(24, number_at<std::uint64_t>(24) + (std::uint64_t{1} << 61)), HasSubstr("impossible"));
  EXPECT_THAT(damage_with(32, std::uint64_t{1}), HasSubstr("its length is not that of its crowns"));
  // Reserved
  EXPECT_EQ(damage_with(63, std::byte{1}), "no damage");
}

TEST_F(SmallPark, EachRuleOfTheCellsIsChecked) {
  EXPECT_THAT(damage_with(first_cell, std::int32_t{3}), HasSubstr("a cell does not exist"));
  EXPECT_THAT(damage_with(first_cell + 4, std::int32_t{-1}), HasSubstr("a cell does not exist"));
  EXPECT_THAT(damage_with(first_cell, std::int32_t{2}), HasSubstr("its cells are not in order"));
  EXPECT_THAT(damage_with(second_cell, std::int32_t{0}), HasSubstr("its cells are not in order"));
  EXPECT_THAT(damage_with(first_cell + 8, std::uint64_t{1}), HasSubstr("the crowns of its cells are not in order"));
  EXPECT_THAT(damage_with(second_cell + 8, ~std::uint64_t{0}), HasSubstr("the crowns of its cells are not in order"));
  EXPECT_THAT(damage_with(second_cell + 16, std::uint32_t{0}), HasSubstr("the crowns of its cells are not in order"));
  EXPECT_THAT(damage_with(second_cell + 16, std::uint32_t{2}), HasSubstr("another number of crowns than its cells own"));
  for (const std::size_t height : {20U, 24U})
    EXPECT_THAT(damage_with(first_cell + height, no_number), HasSubstr("a cell's heights are not those of its crowns"));
  EXPECT_THAT(damage_with(first_cell + 24, number_at<float>(first_cell + 24) - 0.5F), HasSubstr("a cell's heights"));
  EXPECT_EQ(damage_with(first_cell + 28, std::uint32_t{1}), "no damage");
}

TEST_F(SmallPark, EachRuleOfACrownIsChecked) {
  for (const std::size_t coordinate : {0U, 4U})
    for (const float wrong : {-0.001F, 20.001F, infinity, no_number})
      EXPECT_THAT(damage_with(crown(1, coordinate), wrong), HasSubstr("a crown lies outside of its cell"));
  for (const std::size_t height : {8U, 12U})
    for (const float wrong : {-infinity, 1.4e7F, no_number})
      EXPECT_THAT(damage_with(crown(1, height), wrong), HasSubstr("a crown lies nowhere on Earth"));
  EXPECT_THAT(damage_with(crown(1, 12), number_at<float>(crown(1, 8))), HasSubstr("a crown's bottom is not below its top"));
  for (const float wrong : {0.0F, -1.0F, 1.4e7F, infinity, no_number})
    EXPECT_THAT(damage_with(crown(1, 16), wrong), HasSubstr("a crown's half width is impossible"));
  EXPECT_THAT(damage_with(crown(1, 20), std::uint8_t{3}), HasSubstr("a shape that does not exist"));
  EXPECT_THAT(damage_with(crown(1, 21), std::uint8_t{3}), HasSubstr("a foliage that does not exist"));
  EXPECT_THAT(damage_with(crown(1, 22), std::uint16_t{1}), HasSubstr("a crown is turned that is round"));
  EXPECT_EQ(damage_with(crown(0, 22), std::uint16_t{1}), "no damage");
  EXPECT_THAT(damage_with(crown(1, 20), std::uint8_t{1}), HasSubstr("the crowns that the manifest counts"));
}

/// Everything that a user of the file relies on.
bool is_sound(const CrownsFile& file, const Grid& grid) {
  const auto edge_m = static_cast<float>(grid.cell_edge_m);
  for (const CrownCellRecord& cell : file.cells()) {
    if (!grid.cells.contains({cell.i, cell.j})) return false;
    for (const Crown& c : file.crowns_of(cell)) {
      const bool numbers = std::isfinite(c.bottom_m) && c.bottom_m < c.top_m && std::isfinite(c.top_m) && c.half_width_m > 0.0F &&
                           c.half_width_m <= file.largest_half_width_m();
      const bool place = 0.0F <= c.x_m && c.x_m <= edge_m && 0.0F <= c.y_m && c.y_m <= edge_m;
      const bool kinds = c.shape <= CrownShape::prism && c.foliage <= Foliage::deciduous;
      if (!numbers || !place || !kinds || c.bottom_m < cell.z_low_m || c.top_m > cell.z_high_m) return false;
    }
  }
  return true;
}

TEST_F(SmallPark, BytesThatAreChangedWithTheirChecksumAreRefusedOrHarmless) {
  std::size_t refused = 0;
  Manifest manifest = read_manifest(small.folder());
  for (std::size_t n = 0; n < whole.size(); ++n)
    for (const std::byte change : {std::byte{0x01}, std::byte{0x80}, std::byte{0xFF}}) {
      Bytes bytes = whole;
      bytes[n] ^= change;
      write_bytes(path(), bytes);
      manifest.canopy->stamp = stamp_of(path());
      try {
        EXPECT_TRUE(is_sound(CrownsFile(PackageFolder(small.folder()), manifest), manifest.grid)) << n;
      } catch (const PackageDamaged&) {
        ++refused;
      } catch (const PackageUnusable&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, whole.size()) << "the checks see little";
}

TEST_F(SmallPark, FilesThatAreCutWithTheirChecksumAreRefused) {
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
    EXPECT_THAT(damage_of(part), HasSubstr(crowns_file)) << cut;
  }
  Bytes longer = whole;
  longer.resize(whole.size() + sizeof(Crown));
  EXPECT_THAT(damage_of(longer), HasSubstr("its length is not that of its crowns"));
}

}  // namespace
}  // namespace farlod
