// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/relief.hpp"

#include <gmock/gmock.h>

#include <cstddef>
#include <cstring>

#include "package/file_stamp.hpp"
#include "tests/package/small_package.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

class SmallRelief : public testing::Test {
 protected:
  SmallRelief() {
    (void)write_relief(small.folder(), relief);
    whole = bytes_of(path());
  }
  [[nodiscard]] std::filesystem::path path() const { return small.folder() / package::relief_file; }
  [[nodiscard]] package::Manifest manifest_of_this() const {
    package::Manifest manifest = read_manifest(small.folder());
    manifest.relief = stamp_of(path());
    return manifest;
  }
  /// What a reader says of the file where the manifest names it as it is.
  template <class T>
  [[nodiscard]] std::string damage_with(std::size_t offset, T value) const {
    Bytes bytes = whole;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    write_bytes(path(), bytes);
    return damage_met_by([&] { (void)ReliefFile(PackageFolder(small.folder()), manifest_of_this()); });
  }

  SmallPackage small;
  const Relief relief{{{-100.0F, 0.0F, 5.0F}, {-100.0F, 50.0F, 5.0F}, {-200.0F, 0.0F, 80.0F}, {-200.0F, 50.0F, 81.5F}},
                      {{0, 1, 2}, {1, 3, 2}},
                      {}};
  Bytes whole;
};

TEST_F(SmallRelief, ComesBack) {
  const ReliefFile file(PackageFolder(small.folder()), manifest_of_this());
  EXPECT_THAT(file.mesh().vertices, testing::ElementsAreArray(relief.vertices));
  EXPECT_THAT(file.mesh().triangles, testing::ElementsAreArray(relief.triangles));
}

TEST_F(SmallRelief, ThePackageHandsItOutAndNoticesAnother) {
  nlohmann::json m = small.manifest();
  const package::FileStamp stamp = stamp_of(path());
  m["version"] = package::relief_format_version;
  m["relief"] = {{"bytes", stamp.bytes}, {"xxh3", m["blocks"][0]["tiles"]["xxh3"]}};
  small.write_manifest(m);
  EXPECT_THAT(damage_met_by([&] { (void)PackageReader(small.folder()).relief(); }), HasSubstr(package::relief_file));
}

TEST_F(SmallRelief, WithoutTrianglesThereIsNoFile) {
  EXPECT_EQ(write_relief(small.folder() / "other", {}), std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(small.folder() / "other" / package::relief_file));
}

TEST_F(SmallRelief, WhatBreaksARuleIsDamage) {
  using package::ReliefHeader;
  EXPECT_EQ(damage_with(0, 'F'), "no damage");
  EXPECT_THAT(damage_with(0, 'X'), HasSubstr("does not begin as relief.bin does"));
  EXPECT_THAT(damage_with(offsetof(ReliefHeader, triangle_count), std::uint32_t{3}), HasSubstr("its length is not"));
  EXPECT_THAT(damage_with(offsetof(ReliefHeader, file_bytes), std::uint64_t{3}), HasSubstr("its length is not"));
  EXPECT_THAT(damage_with(sizeof(ReliefHeader), 1e9F), HasSubstr("a vertex lies nowhere on Earth"));
  EXPECT_THAT(damage_with(sizeof(ReliefHeader), not_a_number), HasSubstr("a vertex lies nowhere on Earth"));
  EXPECT_THAT(damage_with(sizeof(ReliefHeader) + 4 * sizeof(Point3f), std::uint32_t{4}),
              HasSubstr("a triangle has a vertex that does not exist"));
}

}  // namespace
}  // namespace farlod
