// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/far_terrain.hpp"

#include <gmock/gmock.h>

#include <cstddef>
#include <cstring>

#include "package/file_stamp.hpp"
#include "tests/package/small_package.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

class SmallFarTerrain : public testing::Test {
 protected:
  SmallFarTerrain() {
    (void)write_far_terrain(small.folder(), far_terrain);
    whole = bytes_of(path());
  }
  [[nodiscard]] std::filesystem::path path() const { return small.folder() / package::far_terrain_file; }
  [[nodiscard]] package::Manifest manifest_of_this() const {
    package::Manifest manifest = read_manifest(small.folder());
    manifest.far_terrain = stamp_of(path());
    return manifest;
  }
  /// What a reader says of the file where the manifest names it as it is.
  template <class T>
  [[nodiscard]] std::string damage_with(std::size_t offset, T value) const {
    Bytes bytes = whole;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    write_bytes(path(), bytes);
    return damage_met_by([&] { (void)FarTerrainFile(PackageFolder(small.folder()), manifest_of_this()); });
  }

  SmallPackage small;
  const FarTerrain far_terrain{{{-100.0F, 0.0F, 5.0F}, {-100.0F, 50.0F, 5.0F}, {-200.0F, 0.0F, 80.0F}, {-200.0F, 50.0F, 81.5F}},
                               {{0, 1, 2}, {1, 3, 2}},
                               {}};
  Bytes whole;
};

TEST_F(SmallFarTerrain, ComesBack) {
  const FarTerrainFile file(PackageFolder(small.folder()), manifest_of_this());
  EXPECT_THAT(file.mesh().vertices, testing::ElementsAreArray(far_terrain.vertices));
  EXPECT_THAT(file.mesh().triangles, testing::ElementsAreArray(far_terrain.triangles));
}

TEST_F(SmallFarTerrain, ThePackageHandsItOutAndNoticesAnother) {
  nlohmann::json m = small.manifest();
  const package::FileStamp stamp = stamp_of(path());
  m["version"] = package::far_terrain_format_version;
  m["far_terrain"] = {{"bytes", stamp.bytes}, {"xxh3", m["blocks"][0]["tiles"]["xxh3"]}};
  small.write_manifest(m);
  EXPECT_THAT(damage_met_by([&] { (void)PackageReader(small.folder()).far_terrain(); }), HasSubstr(package::far_terrain_file));
}

TEST_F(SmallFarTerrain, WithoutTrianglesThereIsNoFile) {
  EXPECT_EQ(write_far_terrain(small.folder() / "other", {}), std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(small.folder() / "other" / package::far_terrain_file));
}

TEST_F(SmallFarTerrain, WhatBreaksARuleIsDamage) {
  using package::FarTerrainHeader;
  EXPECT_EQ(damage_with(0, 'F'), "no damage");
  EXPECT_THAT(damage_with(0, 'X'), HasSubstr("does not begin as far_terrain.bin does"));
  EXPECT_THAT(damage_with(offsetof(FarTerrainHeader, triangle_count), std::uint32_t{3}), HasSubstr("its length is not"));
  EXPECT_THAT(damage_with(offsetof(FarTerrainHeader, file_bytes), std::uint64_t{3}), HasSubstr("its length is not"));
  EXPECT_THAT(damage_with(sizeof(FarTerrainHeader), 1e9F), HasSubstr("a vertex lies nowhere on Earth"));
  EXPECT_THAT(damage_with(sizeof(FarTerrainHeader), not_a_number), HasSubstr("a vertex lies nowhere on Earth"));
  EXPECT_THAT(damage_with(sizeof(FarTerrainHeader) + 4 * sizeof(Point3f), std::uint32_t{4}),
              HasSubstr("a triangle has a vertex that does not exist"));
}

}  // namespace
}  // namespace farlod
