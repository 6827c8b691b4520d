// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "package/manifest.hpp"
#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod {
namespace {

using nlohmann::json;
using package::most_layers;
using testing::AllOf;
using testing::HasSubstr;

std::string damage_of(const SmallPackage& small, const json& manifest) {
  small.write_manifest(manifest);
  return damage_met_by([&] { (void)read_manifest(small.folder()); });
}

/// Every place in the manifest, down to the single numbers.
void collect_places(const json& j, const json::json_pointer& here, std::vector<json::json_pointer>& places) {
  if (!here.empty()) places.push_back(here);
  if (j.is_object())
    for (const auto& [key, value] : j.items()) collect_places(value, here / key, places);
  if (j.is_array())
    for (std::size_t n = 0; n < j.size(); ++n) collect_places(j[n], here / n, places);
}

std::vector<json::json_pointer> places_of(const json& manifest) {
  std::vector<json::json_pointer> places;
  collect_places(manifest, json::json_pointer(), places);
  return places;
}

TEST(Package, ManifestMissing) {
  const SmallPackage small;
  std::filesystem::remove(small.folder() / package::manifest_file);
  EXPECT_THROW((void)PackageReader(small.folder()), PackageUnusable);
  EXPECT_THROW((void)PackageReader(small.folder() / "nothing here"), PackageUnusable);
}

TEST(Package, ManifestIsAFolder) {
  const SmallPackage small;
  std::filesystem::remove(small.folder() / package::manifest_file);
  std::filesystem::create_directory(small.folder() / package::manifest_file);
  EXPECT_NE(damage_met_by([&] { (void)PackageReader(small.folder()); }), "no damage");
}

TEST(Package, ManifestTruncated) {
  const SmallPackage small;
  const auto path = small.folder() / package::manifest_file;
  const Bytes whole = bytes_of(path);
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    write_bytes(path, std::span(whole).first(cut));
    EXPECT_THAT(damage_met_by([&] { (void)read_manifest(small.folder()); }), HasSubstr("manifest.json is damaged")) << cut;
  }
}

TEST(Package, ManifestOfAnotherVersion) {
  const SmallPackage small;
  for (const std::uint64_t version : {std::uint64_t{1}, std::uint64_t{package::oldest_format_version} - 1,
                                      std::uint64_t{package::newest_format_version} + 1, std::uint64_t{0xFFFFFFFF}}) {
    json m = small.manifest();
    m["version"] = version;
    m.erase("grid");  // another version may say it otherwise
    small.write_manifest(m);
    EXPECT_THROW((void)read_manifest(small.folder()), PackageUnusable) << version;
  }
}

/// Without a checksum at its end, as versions 6 and 7 have it.
void write_unsealed(const SmallPackage& small, const json& manifest) {
  const std::string text = manifest.dump(1) + "\n";
  write_bytes(small.folder() / package::manifest_file, std::as_bytes(std::span(text)));
}

TEST(Package, ManifestsOfVersions6And7AreRefusedWithAndWithoutAChecksum) {
  const SmallPackage small;
  json m = small.manifest();
  for (const std::uint32_t version : {6U, 7U}) {
    m["version"] = version;
    const std::string refusal = "has format version " + std::to_string(version) + ", this program reads versions 8 to ";
    for (const bool is_sealed : {false, true}) {
      is_sealed ? small.write_manifest(m) : write_unsealed(small, m);
      EXPECT_THAT(scenes::refusal_of<PackageUnusable>([&] { (void)read_manifest(small.folder()); }),
                  AllOf(HasSubstr(refusal), HasSubstr("Pack the city again")));
    }
  }
}

TEST(Package, ManifestsOfTheNewestVersionNeedAChecksum) {
  const SmallPackage small;
  write_unsealed(small, small.manifest());
  EXPECT_THAT(damage_met_by([&] { (void)read_manifest(small.folder()); }), HasSubstr("its checksum is not at its end"));
}

TEST(Package, NoByteOfTheManifestChangesUnnoticed) {
  const Bytes bytes = bytes_of(SmallPackage(FarMapKind::horizon).folder() / package::manifest_file);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto damage = [&] { return damage_met_by([&] { (void)manifest_from_text(text, "manifest.json"); }); };
  ASSERT_EQ(damage(), "no damage");
  for (char& byte : text)
    for (std::uint32_t bit = 0; bit < 8; ++bit) {
      const char whole = byte;
      byte = static_cast<char>(static_cast<unsigned char>(whole) ^ (1U << bit));
      EXPECT_THAT(damage(), HasSubstr("manifest.json is damaged")) << "bit " << bit << " of byte " << &byte - text.data();
      byte = whole;
    }
  text += '\n';
  EXPECT_NE(damage(), "no damage");
}

TEST(Package, AVersionThatDamageHasMadeIsNoNewerOne) {
  const SmallPackage small;
  const auto path = small.folder() / package::manifest_file;
  const Bytes bytes = bytes_of(path);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text.replace(text.find("\"version\": 10"), 13, "\"version\": 11");
  write_bytes(path, std::as_bytes(std::span(text)));
  EXPECT_THAT(damage_met_by([&] { (void)read_manifest(small.folder()); }), HasSubstr("checksum"));
}

TEST(Package, ManifestNestedTooDeep) {
  const SmallPackage small;
  json m = small.manifest();
  json deep = 1;
  for (int level = 0; level < 31; ++level) deep = json::array({deep});
  m["weather"] = deep;
  EXPECT_EQ(damage_of(small, m), "no damage");
  m["weather"] = json::array({deep});
  EXPECT_THAT(damage_of(small, m), HasSubstr("nested deeper than 32"));
  const std::string endless(1'000'000, '[');
  EXPECT_THAT(damage_met_by([&] { (void)manifest_from_text(endless, "manifest.json"); }), HasSubstr("nested deeper than 32"));
}

TEST(Package, BracketsInTextAreNoNesting) {
  const SmallPackage small;
  json m = small.manifest();
  m["weather"] = "\\\"" + std::string(100, '[') + "\"";
  EXPECT_EQ(damage_of(small, m), "no damage");
}

TEST(Package, MessagesRepeatLittleOfAManifest) {
  const SmallPackage small;
  json m = small.manifest();
  m["settings"]["far_map"]["kind"] = std::string(100'000, 'k');
  EXPECT_LT(damage_of(small, m).size(), 1000U);
}

TEST(Package, ManifestOfNoVersion) {
  const SmallPackage small;
  // The last would be ours, were it cut to 32 bits
  for (const json& version :
       {json(0), json(-1), json("2"), json(2.5), json(true), json((std::uint64_t{1} << 32) + package::format_version)}) {
    json m = small.manifest();
    m["version"] = version;
    EXPECT_NE(damage_of(small, m), "no damage") << version;
  }
}

/// The manifest of the small package, were only some of its cells mapped: the runs are those of its block of two cells.
json partial_manifest(const SmallPackage& small, const json& runs) {
  json m = small.manifest();
  m["blocks"][0]["cells_with_far_map"] = runs;
  return m;
}

TEST(Package, ManifestOfSomeFarMaps) {
  const SmallPackage small;
  small.write_manifest(partial_manifest(small, {{1, 2}}));
  const package::Manifest m = read_manifest(small.folder());
  EXPECT_FALSE(m.is_fully_mapped());
  EXPECT_EQ(m.cells_with_far_map(), 2U);
  EXPECT_FALSE(m.blocks[0].has_far_map(0));
  EXPECT_TRUE(m.blocks[0].has_far_map(1));
  EXPECT_TRUE(m.blocks[1].has_far_map(0));
  EXPECT_EQ(package::folder_of(m.blocks[0]), "blocks/0_0_1");
  EXPECT_EQ(package::folder_of(m.blocks[1]), "blocks/1_0");
}

TEST(Package, ManifestOfABlockWithoutFarMaps) {
  const SmallPackage small;
  json m = partial_manifest(small, json::array());
  m["blocks"][0]["far_map"] = nullptr;
  small.write_manifest(m);
  EXPECT_FALSE(read_manifest(small.folder()).blocks[0].has_far_maps());
  EXPECT_EQ(package::folder_of(read_manifest(small.folder()).blocks[0]), "blocks/0_0_0");
}

TEST(Package, ManifestTellsTheBoxOfTheBuildings) {
  const SmallPackage small;
  json m = small.manifest();
  m.erase("buildings_box_m");
  small.write_manifest(m);
  package::Manifest read = read_manifest(small.folder());
  EXPECT_EQ(read.buildings_projected, std::nullopt);
  EXPECT_EQ(read.city_projected(), read.projected_outline(read.grid.rectangle()));
  m["buildings_box_m"] = {10.0, 20.0, 30.5, 41.0};
  small.write_manifest(m);
  read = read_manifest(small.folder());
  EXPECT_EQ(read.city_projected(), (Box2d{{5.0, 15.0}, {35.5, 46.0}}));
  EXPECT_EQ(manifest_from_text(manifest_text(read), "again").buildings_projected, read.buildings_projected);
  read.pixels = package::SurfacePixels{{100.0, 200.0}, 2.0, 10, 5};
  EXPECT_EQ(read.city_projected(), (Box2d{{100.0, 190.0}, {120.0, 200.0}}));
  for (const char* box : {"[10, 20, 9, 41]", "[10, 20, 30, 19]", "[0, 0, 3e9, 1]", "[-3e9, 0, 0, 1]", "[1, 2, 3]", "\"all\""}) {
    m["buildings_box_m"] = json::parse(box);
    EXPECT_NE(damage_of(small, m), "no damage") << box;
  }
}

TEST(Package, ManifestOfImpossibleFarMaps) {
  const SmallPackage small;
  ASSERT_EQ(damage_of(small, partial_manifest(small, {{0, 1}})), "no damage");
  for (const char* runs : {"[[0,2]]", "[[0,1],[1,2]]", "[[1,2],[0,1]]", "[[1,1]]", "[[1,0]]", "[[2,3]]", "[[0,3]]", "[[0]]",
                           "[[0,1,2]]", "[0,1]", "[[-1,1]]", "[[0,4294967297]]", "[[0,0.5]]", "\"0\"", "true"})
    EXPECT_NE(damage_of(small, partial_manifest(small, json::parse(runs))), "no damage") << runs;
  json without_stamp = partial_manifest(small, {{0, 1}});
  without_stamp["blocks"][0]["far_map"] = nullptr;
  EXPECT_NE(damage_of(small, without_stamp), "no damage");
}

class ManifestOfKind : public testing::TestWithParam<FarMapKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ManifestOfKind, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

TEST_P(ManifestOfKind, WithMissingKey) {
  const SmallPackage small(GetParam());
  const json whole = small.manifest();
  ASSERT_EQ(damage_of(small, whole), "no damage");
  for (const json::json_pointer& place : places_of(whole)) {
    json m = whole;
    json& parent = m[place.parent_pointer()];
    if (parent.is_object()) parent.erase(place.back());
    if (parent.is_array()) parent.erase(static_cast<std::size_t>(std::stoul(place.back())));
    if (place == json::json_pointer("/inputs/0")) continue;  // the list of inputs may be of any length
    EXPECT_NE(damage_of(small, m), "no damage") << place;
  }
}

TEST_P(ManifestOfKind, WithSomethingElseInAPlace) {
  const SmallPackage small(GetParam());
  const json whole = small.manifest();
  for (const json::json_pointer& place : places_of(whole))
    for (const json& other : {json::object({{"a", 1}}), json(true)}) {
      json m = whole;
      m[place] = other;
      // A count of problems by code is an object itself, but "a" is no code
      EXPECT_NE(damage_of(small, m), "no damage") << place << " = " << other;
    }
}

TEST_P(ManifestOfKind, WithAFractionForAWholeNumber) {
  const SmallPackage small(GetParam());
  const json whole = small.manifest();
  for (const json::json_pointer& place : places_of(whole)) {
    if (!whole[place].is_number_integer()) continue;
    json m = whole;
    m[place] = whole[place].get<double>() + 0.5;
    EXPECT_NE(damage_of(small, m), "no damage") << place;
  }
}

TEST(Package, ManifestWithAnImpossibleGrid) {
  const SmallPackage small;
  const std::int64_t most = std::numeric_limits<std::int32_t>::max(), least = std::numeric_limits<std::int32_t>::min();
  // Too many cells to list, differences that do not fit 32 bits, an empty range
  const json ranges[] = {{0, 0, 1 << 29, 1 << 29},
                         {0, 0, 100000, 100000},
                         {least, least, most, most},
                         {-1000000000, 0, most, 1},
                         {0, 0, 3, most},
                         {3, 0, 3, 1},
                         {5, 0, 3, 1},
                         {5, 5, 3, 3},
                         {0, 0, 3, std::int64_t{1} << 32},
                         {0, 0, std::int64_t{1} << 40, 1},
                         {0, 0, 3},
                         {0, 0, 3, 1, 1}};
  for (const json& cells : ranges)
    for (const int block_edge : {1, 2, 4096}) {
      json m = small.manifest();
      m["grid"]["cells"] = cells;
      m["grid"]["block_edge"] = block_edge;
      EXPECT_NE(damage_of(small, m), "no damage") << cells << ", blocks of " << block_edge;
      m["grid"]["cells"] = {0, 0, 3, 1};
      m["grid"]["block_edge"] = 2;
      small.write_manifest(m);
    }
}

TEST(Package, ManifestWithImpossibleSettings) {
  const SmallPackage small;
  const json whole = small.manifest();
  const std::vector<std::pair<std::string, std::vector<json>>> changes{
      {"/format", {json("other")}},
      {"/grid/cell_m", {0.0, -20.0, 20.1, 1e-30, 1e300}},
      {"/grid/neighborhood", {0, 2, -1}},
      {"/grid/block_edge", {0, 3, 100000}},
      {"/settings/assign", {json("somehow")}},
      {"/settings/far_map/kind", {json("globe")}},
      {"/settings/far_map/rows", {0, 4000000000U}},
      {"/settings/far_map/side_columns", {0, 1 << 30}},
      {"/blocks/0/i", {json(1)}},
      {"/blocks/0/tiles/xxh3", {"xyz", "", "00000000000000000f0"}},
      {"/blocks/0/tiles/bytes", {json(-1)}},
      {"/crs/epsg", {json(std::int64_t{1} << 33)}},
      {"/frame/origin_m/0", {json(1e300)}},
      {"/frame/origin_m/1", {json(-2e9)}},
      {"/frame/height_origin_m", {json(1e12)}},
      {"/counts/buildings", {json(-1)}}};
  for (const auto& [place, values] : changes)
    for (const json& value : values) {
      json m = whole;
      m[json::json_pointer(place)] = value;
      const std::string damage = damage_of(small, m);
      const bool harmless = place == "/blocks/0/tiles/xxh3" && value == "00000000000000000f0";
      EXPECT_EQ(damage == "no damage", harmless) << place << " = " << value << ": " << damage;
    }
}

TEST(Package, ManifestWithImpossibleHorizons) {
  const SmallPackage small(FarMapKind::horizon);
  const json whole = small.manifest();
  const std::pair<const char*, json> changes[] = {
      {"azimuth_bins", 0},     {"azimuth_bins", 65537}, {"azimuth_bins", -8},        {"squares_per_edge", 0},
      {"squares_per_edge", 5}, {"layers", 0},           {"layers", most_layers + 1}, {"tolerance", -0.1},
      {"tolerance", nullptr},  {"kind", "box"},         {"kind", "Horizon"}};
  for (const auto& [key, value] : changes) {
    json m = whole;
    m["settings"]["far_map"][key] = value;
    EXPECT_NE(damage_of(small, m), "no damage") << key << " = " << value;
  }
  for (const auto& [key, value] : {std::pair<const char*, json>{"azimuth_bins", 65536},
                                   {"squares_per_edge", 4},
                                   {"layers", most_layers},
                                   {"tolerance", 0}}) {
    json m = whole;
    m["settings"]["far_map"][key] = value;
    EXPECT_EQ(damage_of(small, m), "no damage") << key << " = " << value;
  }
}

TEST(Package, ManifestThatIsNotJson) {
  const SmallPackage small;
  const auto path = small.folder() / package::manifest_file;
  for (const std::string text : {"", "[]", "null", "7", "{}", "\xFF\xFE", "{\"frame\": {\"height_origin_m\": 1e999}}"}) {
    write_bytes(path, std::as_bytes(std::span(text)));
    EXPECT_NE(damage_met_by([&] { (void)read_manifest(small.folder()); }), "no damage") << text;
  }
}

TEST(Package, UnknownKeysOfTheManifestAreSkipped) {
  const SmallPackage small;
  json m = small.manifest();
  m["weather"] = {{"wind", 3}};
  m["grid"]["colour"] = "grey";
  m["blocks"][0]["tiles"]["crc"] = 1;
  EXPECT_EQ(damage_of(small, m), "no damage");
}

TEST_P(ManifestOfKind, IsDocumentedKeyByKey) {
  std::ifstream file(std::string(FARLOD_SOURCE_DIR) + "/docs/package_format.md");
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  const json m = SmallPackage(GetParam()).manifest();
  for (const json::json_pointer& place : places_of(m)) {
    if (m[place].is_structured() && !m[place].is_array()) continue;
    std::string key;
    for (json::json_pointer p = place; !p.empty(); p.pop_back()) {
      const bool is_index = p.back().find_first_not_of("0123456789") == std::string::npos;
      key = (is_index ? "[]" : "." + p.back()) + key;
    }
    key.erase(0, 1);
    // The table has one row for a list of numbers, and one for a stamp
    if (key.ends_with("[]") || (key.starts_with("blocks[].") && key.find('.', 9) != std::string::npos)) continue;
    if (key == "inputs" || key == "blocks") continue;
    EXPECT_NE(document.find("`" + key + "`"), std::string::npos) << "docs/package_format.md lacks " << key;
  }
}

}  // namespace
}  // namespace farlod
