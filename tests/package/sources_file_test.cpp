// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/sources_file.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <random>
#include <set>

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
  /// Where `all_of_file`, all buildings with an origin are of the file with places.
  void write(const std::vector<BuildingOrigin>& origins, bool all_of_file = true) {
    TileSources sources;
    for (const BuildingOrigin& origin : origins) {
      std::vector<std::uint8_t> bytes;
      if (!origin.objects.empty()) append_origin(bytes, origin);
      sources.buildings.push_back({origin.objects.empty() || !all_of_file ? 0U : 1U, bytes.size()});
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

TEST_F(SmallSources, IdsMakeAVersionOfTheirOwn) {
  BuildingOrigin named = first;
  named.ids = {{0, 2, "UUID_cddb67ba-46f5-479e-bda0-4563cd4835bf"}, {5, 6, "_wall", true}};
  write({named, {}, second});
  const Manifest manifest = manifest_of_this();
  const SourcesFile sources(PackageFolder(small.folder()), manifest);
  EXPECT_EQ(static_cast<int>(whole[8]), static_cast<int>(sources_version_with_ids));
  EXPECT_EQ(sources.find(0), named);
  EXPECT_EQ(sources.find(1), std::nullopt);
  EXPECT_EQ(sources.find(2), second);
  EXPECT_EQ(sources.find(3), std::nullopt);
  EXPECT_THAT(damage_with(8, sources_version), HasSubstr("its version has no ids"));
}

TEST_F(SmallSources, BuildingsOfFilesWithoutPlacesHaveIds) {
  BuildingOrigin named{{{}}, {}, {}, {{0, 1, "a"}}};
  write({named, {}, named}, false);
  const SourcesFile sources(PackageFolder(small.folder()), manifest_of_this());
  EXPECT_EQ(sources.find(0), named);
  EXPECT_EQ(sources.find(1), std::nullopt);
  EXPECT_EQ(sources.find(2), named);
  sources.visit([](std::uint32_t, std::size_t, const BuildingOrigin&) { ADD_FAILURE() << "it has no places"; });
}

TEST_F(SmallSources, WithoutIdsAreAsTheyWere) { EXPECT_EQ(static_cast<int>(whole[8]), static_cast<int>(sources_version)); }

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
  const std::uint32_t version = sources_version_with_ids + 1;
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

// How a building of the file is written

/// Ids as programs make them, and some that only look like it.
std::string random_id(std::mt19937_64& random) {
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  std::string id(random() % 3 == 0 ? "UUID_" : random() % 2 == 0 ? std::string(1, '\0') : "x");
  const std::uint64_t kinds = random() % 3 == 0 ? 22 : 16, first = random() % 4 == 0 ? 10 : 0;
  for (const std::size_t length : {8U, 4U, 4U, 4U, 12U}) {
    for (std::size_t n = 0; n < length; ++n) {
      const std::uint64_t digit = random() % kinds;
      id += digits[first > 0 && digit >= 10 ? digit + (kinds == 16 ? 6 : 0) : digit];
    }
    if (random() % 40 != 0) id += '-';
  }
  if (random() % 4 != 0) id.pop_back();
  if (random() % 3 == 0) id += "_7";
  return random() % 4 == 0 ? "wall " + std::to_string(random() % 100) : id;
}

std::vector<SurfaceIds> random_ids(std::mt19937_64& random) {
  std::vector<SurfaceIds> ids;
  std::uint32_t end = 0;
  for (std::uint64_t n = random() % 6; n > 0; --n) {
    const std::uint32_t begin = end + static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 1000 : 0);
    end = begin + 1 + static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 100 : 0);
    SurfaceIds& added = ids.emplace_back(
        SurfaceIds{begin, end, random() % 4 == 0 && !ids.empty() ? ids.back().id : random_id(random), random() % 5 == 0});
    // No text begins with a byte 0
    if (added.id.empty() || added.id.front() == '\0') added.id.replace(0, 1, "a");
  }
  return ids;
}

/// A building drawn at random: numbers may be any that the types hold.
BuildingOrigin random_origin(std::mt19937_64& random) {
  const auto below = [&](std::uint64_t count) { return random() % count; };
  BuildingOrigin origin;
  const auto add_places = [&](std::vector<AttributePlace>& places, std::uint64_t count) {
    while (places.size() < count)
      places.push_back(
          {below(3) == 0 ? random() >> 4U : below(100'000), static_cast<std::uint32_t>(below(4) == 0 ? random() : below(3))});
  };
  add_places(origin.objects, 1 + below(4));
  add_places(origin.semantics, below(6));
  std::uint32_t surface = 0;
  for (std::uint64_t n = below(20); n > 0; --n) {
    surface += static_cast<std::uint32_t>(below(20) == 0 ? below(200'000'000) : below(3));
    SurfaceOrigin& added = origin.surfaces.emplace_back();
    added.surface = surface;
    added.object = static_cast<std::uint32_t>(below(origin.objects.size()));
    if (!origin.semantics.empty() && below(3) > 0) added.semantics = static_cast<std::uint32_t>(below(origin.semantics.size()));
  }
  origin.ids = random_ids(random);
  return origin;
}

TEST(SourcesLayout, AnOriginComesBackFromItsBytes) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 20'000; ++n) {
    const BuildingOrigin origin = random_origin(random);
    std::vector<std::uint8_t> bytes;
    append_origin(bytes, origin);
    ASSERT_EQ(origin_from(bytes), origin) << "the " << n << "th of the seed";
  }
}

TEST(SourcesLayout, BytesThatAreCutOrGoOnAreNoOrigin) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 500; ++n) {
    std::vector<std::uint8_t> bytes;
    append_origin(bytes, random_origin(random));
    BuildingOrigin without_ids = *origin_from(bytes);
    without_ids.ids.clear();
    std::vector<std::uint8_t> shorter;
    append_origin(shorter, without_ids);
    // Where ids could begin, an origin without ids ends
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_EQ(origin_from(std::span(bytes).first(size)).has_value(), size == shorter.size());
    bytes.push_back(0);
    EXPECT_FALSE(origin_from(bytes).has_value());
  }
}

TEST(SourcesLayout, AnyBytesAreAnOriginOfWhatIsThereOrNone) {
  std::mt19937_64 random(3);
  std::size_t origins = 0;
  for (int n = 0; n < 200'000; ++n) {
    std::vector<std::uint8_t> bytes(random() % 24);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % (random() % 8 == 0 ? 256 : 6));
    const std::optional<BuildingOrigin> origin = origin_from(bytes);
    if (!origin) continue;
    ++origins;
    ASSERT_FALSE(origin->objects.empty());
    for (std::size_t k = 0; k < origin->surfaces.size(); ++k) {
      const SurfaceOrigin& surface = origin->surfaces[k];
      ASSERT_LT(surface.object, origin->objects.size());
      ASSERT_TRUE(!surface.semantics || *surface.semantics < origin->semantics.size());
      ASSERT_TRUE(k == 0 || origin->surfaces[k - 1].surface <= surface.surface);
    }
  }
  EXPECT_GT(origins, 100U);
}

TEST(SourcesLayout, WhatFollowsTakesOneByte) {
  // 100 walls, each of a semantic surface of its own, 120 bytes from one to the next
  BuildingOrigin origin{{{1000, 1}}, {}, {}};
  for (std::uint32_t n = 0; n < 100; ++n) {
    origin.semantics.push_back({1100 + 120 * std::uint64_t{n}, 1});
    origin.surfaces.push_back({n, 0, n});
  }
  std::vector<std::uint8_t> bytes;
  append_origin(bytes, origin);
  EXPECT_LE(bytes.size(), 10U + 2U * 100U + 100U);
}

TEST(SourcesLayout, AUuidTakesItsBytesAndTwoOfItsPlace) {
  BuildingOrigin origin{{{1000, 1}}, {}, {}, {}};
  std::vector<std::uint8_t> before, bytes;
  append_origin(before, origin);
  constexpr std::uint32_t count = 100;
  std::mt19937_64 random(4);
  for (std::uint32_t n = 0; n < count; ++n) {
    std::string id = "UUID_00000000-0000-0000-0000-000000000000";
    for (char& digit : id)
      if (digit == '0') digit = "0123456789abcdef"[random() % 16];
    origin.ids.push_back({n, n + 1, id});
  }
  append_origin(bytes, origin);
  EXPECT_LE(bytes.size(), before.size() + 1U + 5U + (16U + 2U) * count + count / 4U);
}

TEST(SourcesLayout, NumbersOfAllSizesComeBack) {
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint64_t> numbers{0, 1, 127, 128, 16'383, 16'384, 0x7FFF'FFFF'FFFF'FFFF, 0xFFFF'FFFF'FFFF'FFFF};
  for (const std::uint64_t number : numbers) append_number(bytes, number);
  SourcesCursor cursor(bytes);
  for (const std::uint64_t number : numbers) EXPECT_EQ(cursor.number(), number);
  EXPECT_TRUE(cursor.at_end() && !cursor.failed());
  for (const std::uint64_t number : numbers) EXPECT_EQ(difference_of(unsigned_of(number)), number);
  EXPECT_EQ(unsigned_of(std::uint64_t{0} - 1), 1U);
  // One bit more than 64
  const std::vector<std::uint8_t> too_large{255, 255, 255, 255, 255, 255, 255, 255, 255, 2};
  SourcesCursor beyond(too_large);
  EXPECT_EQ(beyond.number(), 0U);
  EXPECT_TRUE(beyond.failed());
}

TEST(CellRuns, OfNeighborsIsOneRun) {
  const std::vector<std::size_t> places{0, 1, 2, 5, 7, 8};
  EXPECT_EQ(CellRuns::of(places), (CellRuns{{{0, 3}, {5, 6}, {7, 9}}}));
  EXPECT_EQ(CellRuns::of({}), CellRuns{});
}

/// A set of numbers says the same.
TEST(CellRuns, SayWhatASetSays) {
  std::mt19937 random(3);
  for (int n = 0; n < 50; ++n) {
    std::set<std::size_t> set;
    for (std::size_t k = random() % 40; k > 0; --k) set.insert(random() % 40);
    const std::vector<std::size_t> places(set.begin(), set.end());
    const CellRuns runs = CellRuns::of(places);
    EXPECT_EQ(runs.size(), set.size());
    EXPECT_EQ(runs.places(), places);
    std::size_t before = 0;
    for (std::size_t place = 0; place < 45; ++place) {
      EXPECT_EQ(runs.contains(place), set.contains(place)) << place;
      EXPECT_EQ(runs.count_before(place), before) << place;
      before += set.contains(place) ? 1 : 0;
    }
  }
}

TEST(CellRuns, TilesOfAPictureAreInOneColumn) {
  const CellRange cells{-1, 2, 2, 4};
  const std::vector<std::size_t> places{1, 3, 5};
  const std::optional<CellRuns> some = CellRuns::of(places);
  EXPECT_EQ(picture_tiles(cells, some).columns, 1);
  EXPECT_EQ(picture_tiles(cells, some).rows, 3);
  for (std::int32_t k = 0; k < 3; ++k) {
    const PictureTile tile = picture_tile(cells.cell_at(places[static_cast<std::size_t>(k)]), cells, some);
    EXPECT_EQ(tile.column, 0);
    EXPECT_EQ(tile.row, k);
  }
  EXPECT_EQ(picture_tiles(cells, std::nullopt).columns, 3);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).column, 2);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).row, 1);
}

}  // namespace
}  // namespace farlod
