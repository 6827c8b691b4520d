// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/sources_file.hpp"

#include <gmock/gmock.h>

#include <cstring>

#include "package/file_stamp.hpp"
#include "package/manifest.hpp"
#include "tests/package/small_package.hpp"

namespace farlod {
namespace {

using namespace package;
using testing::HasSubstr;

/// The small package with three buildings: two of a city file, and one of another kind of file.
class SmallSources : public testing::Test {
 protected:
  SmallSources() {
    nlohmann::json m = small.manifest();
    m["counts"]["buildings"] = 3;
    m["inputs"] = {{{"name", "town.shp"}, {"bytes", 7}, {"xxh3", "1"}}, {{"name", "town.gml"}, {"bytes", 900}, {"xxh3", "2"}}};
    small.write_manifest(m);
    write({first, {}, second});
  }

  /// Writes buildings with these origins; those without are of the file that has no places.
  void write(const std::vector<BuildingOrigin>& origins) {
    TileSources sources;
    for (const BuildingOrigin& origin : origins) {
      std::vector<std::uint8_t> bytes;
      if (!origin.objects.empty()) append_origin(bytes, origin);
      sources.buildings.push_back({origin.objects.empty() ? 0U : 1U, bytes.size()});
      sources.origins.append(std::span<const std::uint8_t>(bytes));
    }
    const std::vector<std::optional<SourceOfPackage>> files{std::nullopt,
                                                            SourceOfPackage{input, CityFileFormat::cityjson, {form}}};
    (void)write_sources(small.folder(), sources, files);
    whole = bytes_of(path());
  }
  [[nodiscard]] std::filesystem::path path() const { return small.folder() / sources_file; }
  [[nodiscard]] Manifest manifest_of_this() const {
    Manifest manifest = read_manifest(small.folder());
    manifest.sources = stamp_of(path());
    return manifest;
  }
  /// What a reader says of these bytes, whose size and checksum are in the manifest.
  [[nodiscard]] std::string damage_of(const Bytes& bytes) const {
    write_bytes(path(), bytes);
    return damage_met_by([&] { (void)SourcesFile(PackageFolder(small.folder()), manifest_of_this()); });
  }
  template <class T>
  [[nodiscard]] std::string damage_with(std::size_t offset, T value) const {
    Bytes bytes = whole;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return damage_of(bytes);
  }

  SmallPackage small;
  Bytes whole;
  std::uint32_t input = 1;
  AttributeForm form{",\"attributes\":{", "\"", "\":", "", ",", "}"};
  const BuildingOrigin first{{{100, 1}}, {{300, 1}, {200, 0}}, {{0, 0, 1}, {2, 0, 0}, {2, 0, 1}}};
  const BuildingOrigin second{{{900, 1}, {800, 1}}, {}, {{7, 1, {}}}};
};

TEST_F(SmallSources, ComeBack) {
  const SourcesFile sources(PackageFolder(small.folder()), manifest_of_this());
  ASSERT_EQ(sources.files().size(), 1U);
  EXPECT_EQ(sources.files()[0].input.name, "town.gml");
  EXPECT_EQ(sources.files()[0].input.bytes, 900U);
  EXPECT_EQ(sources.files()[0].format, CityFileFormat::cityjson);
  EXPECT_EQ(sources.files()[0].forms, std::vector{form});
  std::vector<std::pair<std::uint32_t, BuildingOrigin>> origins;
  sources.visit([&](std::uint32_t building, std::size_t file, const BuildingOrigin& origin) {
    EXPECT_EQ(file, 0U);
    origins.emplace_back(building, origin);
  });
  EXPECT_EQ(origins, (std::vector<std::pair<std::uint32_t, BuildingOrigin>>{{0, first}, {2, second}}));
}

TEST_F(SmallSources, EachByteIsChecked) {
  const Manifest manifest = manifest_of_this();
  const auto damage = [&] { return damage_met_by([&] { (void)SourcesFile(PackageFolder(small.folder()), manifest); }); };
  EXPECT_EQ(damage(), "no damage");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    Bytes bytes = whole;
    bytes[n] ^= std::byte{1};
    write_bytes(path(), bytes);
    EXPECT_NE(damage(), "no damage") << "byte " << n;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path(), Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_NE(damage(), "no damage") << size << " bytes";
  }
}

TEST_F(SmallSources, WhatBreaksARuleIsDamage) {
  EXPECT_EQ(damage_of(whole), "no damage");
  EXPECT_THAT(damage_with(0, 'X'), HasSubstr("does not begin as sources.bin does"));
  EXPECT_THAT(damage_with(16, std::uint64_t{4}), HasSubstr("does not have the buildings that the manifest counts"));
  EXPECT_THAT(damage_with(24, std::uint64_t{9}), HasSubstr("its length is another one than it says"));
  EXPECT_THAT(damage_with(12, std::uint32_t{2}), HasSubstr("is damaged"));
  EXPECT_THAT(damage_with(12, std::uint32_t{0}), HasSubstr("of a file that does not exist"));
  EXPECT_THAT(damage_with(64, std::uint8_t{2}), HasSubstr("a file is no input of the manifest"));
  EXPECT_THAT(damage_with(65, std::uint8_t{4}), HasSubstr("of a format that does not exist"));
  Bytes longer = whole;
  longer.push_back(std::byte{0});
  const std::uint64_t size = longer.size();
  std::memcpy(longer.data() + 24, &size, sizeof size);
  EXPECT_THAT(damage_of(longer), HasSubstr("its length is not that of its contents"));
  BuildingOrigin beyond = first;
  beyond.semantics[0].at = 901;
  write({beyond, {}, second});
  EXPECT_THAT(damage_of(whole), HasSubstr("a place is not in its file"));
  beyond.semantics[0] = {300, 2};
  write({beyond, {}, second});
  EXPECT_THAT(damage_of(whole), HasSubstr("a place is not in its file"));
}

TEST_F(SmallSources, AnotherVersionIsRefused) {
  Bytes bytes = whole;
  const std::uint32_t version = sources_version + 1;
  std::memcpy(bytes.data() + 8, &version, sizeof version);
  write_bytes(path(), bytes);
  EXPECT_THROW((void)SourcesFile(PackageFolder(small.folder()), manifest_of_this()), PackageUnusable);
}

TEST_F(SmallSources, AreNamedByTheManifest) {
  nlohmann::json m = small.manifest();
  const FileStamp stamp = stamp_of(path());
  std::ostringstream digits;
  digits << std::hex << stamp.xxh3;
  m["sources"] = {{"bytes", stamp.bytes}, {"xxh3", digits.str()}};
  m["version"] = format_version;
  small.write_manifest(m);
  ASSERT_TRUE(read_manifest(small.folder()).sources.has_value());
  EXPECT_EQ(damage_of(whole), "no damage");
  // A package of version 9 has no such key
  m["version"] = canopy_format_version - 1;
  small.write_manifest(m);
  EXPECT_FALSE(read_manifest(small.folder()).sources.has_value());
}

TEST(SourcesWriter, FilesWithoutPlacesHaveNone) {
  const scenes::TemporaryFolder folder;
  EXPECT_FALSE(write_sources(folder.path(), {}, {}).has_value());
  const std::vector<std::optional<SourceOfPackage>> none(2);
  EXPECT_FALSE(write_sources(folder.path(), {}, none).has_value());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / sources_file));
}

}  // namespace
}  // namespace farlod
