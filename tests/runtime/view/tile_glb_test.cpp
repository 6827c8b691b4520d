// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_glb.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace farlod {
namespace {

using nlohmann::json;

/// A GLB, read by what it says of itself.
struct Glb {
  json head;
  std::string bytes;

  explicit Glb(const std::string& file) {
    std::uint32_t length = 0, all = 0;
    std::memcpy(&all, file.data() + 8, sizeof(all));
    std::memcpy(&length, file.data() + 12, sizeof(length));
    EXPECT_EQ(all, file.size());
    EXPECT_EQ(length % 4, 0U);
    head = json::parse(file.substr(20, length));
    if (file.size() > 28 + length) bytes = file.substr(28 + length);
  }
  [[nodiscard]] std::string view(std::size_t n) const {
    const json& v = head.at("bufferViews").at(n);
    return bytes.substr(v.at("byteOffset").get<std::size_t>(), v.at("byteLength").get<std::size_t>());
  }
  [[nodiscard]] std::vector<float> floats(std::size_t primitive, const char* attribute) const {
    const json& a = head.at("meshes").at(0).at("primitives").at(primitive).at("attributes").at(attribute);
    const std::string text = view(head.at("accessors").at(a.get<std::size_t>()).at("bufferView").get<std::size_t>());
    std::vector<float> numbers(text.size() / sizeof(float));
    std::memcpy(numbers.data(), text.data(), text.size());
    return numbers;
  }
};

TileSurfaces two_facets() {
  TileSurfaces surfaces{{}, {{"", 0, SurfaceKind::ground}, {"Haus \"A\"", 7, SurfaceKind::wall}}};
  surfaces.facets.push_back({{{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0}}}, {}, {0.0, 0.0, 1.0}, 0});
  surfaces.facets.push_back({{{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 0.0, 20.0}}}, {}, {0.0, -1.0, 0.0}, 1});
  return surfaces;
}

TEST(TileGlb, HasPlacesValuesAndFeatures) {
  const Glb glb(glb_of(two_facets(), std::vector{0.25F, 0.5F}));
  ASSERT_EQ(glb.head.at("meshes").at(0).at("primitives").size(), 1U);
  EXPECT_EQ(glb.floats(0, "_SVF"), (std::vector{0.25F, 0.25F, 0.25F, 0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(glb.floats(0, "_FEATURE_ID_0"), (std::vector{0.0F, 0.0F, 0.0F, 1.0F, 1.0F, 1.0F}));
  // y up, around the middle (5, 5, 10)
  const auto moved = glb.head.at("nodes").at(0).at("translation").get<std::vector<double>>();
  EXPECT_EQ(moved, (std::vector{5.0, 10.0, -5.0}));
  const std::vector<float> places = glb.floats(0, "POSITION");
  EXPECT_EQ(std::vector(places.end() - 3, places.end()), (std::vector{5.0F, 10.0F, 5.0F})) << "(10, 0, 20)";
  const std::vector<float> ramp = glb.floats(0, "TEXCOORD_0");
  EXPECT_FLOAT_EQ(ramp[0], (0.25F * 255.0F + 0.5F) / 256.0F);
}

TEST(TileGlb, FacetsWithoutAValueAreGreyOnes) {
  const Glb glb(glb_of(two_facets(), std::vector{NAN, 0.5F}));
  const json& primitives = glb.head.at("meshes").at(0).at("primitives");
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(glb.head.at("materials").at(primitives.at(1).at("material").get<std::size_t>()).at("name"), "no data");
  EXPECT_FALSE(primitives.at(1).at("attributes").contains("_SVF"));
  EXPECT_EQ(glb.floats(1, "_FEATURE_ID_0"), std::vector(3, 0.0F));
}

TEST(TileGlb, FeaturesAreATable) {
  const Glb glb(glb_of(two_facets(), std::vector{0.25F, 0.5F}));
  const json& table = glb.head.at("extensions").at("EXT_structural_metadata").at("propertyTables").at(0);
  EXPECT_EQ(table.at("count"), 2);
  const json& building = table.at("properties").at("building");
  EXPECT_EQ(glb.view(building.at("values").get<std::size_t>()), "Haus \"A\"");
  const std::string offsets = glb.view(building.at("stringOffsets").get<std::size_t>());
  std::array<std::uint32_t, 3> begins{};
  ASSERT_EQ(offsets.size(), sizeof(begins));
  std::memcpy(begins.data(), offsets.data(), sizeof(begins));
  EXPECT_EQ(begins, (std::array<std::uint32_t, 3>{0, 0, 8}));
  EXPECT_EQ(glb.view(table.at("properties").at("kind").at("values").get<std::size_t>()), "groundwall");
}

TEST(TileGlb, NothingIsAnEmptyScene) {
  const Glb glb(glb_of({}, {}));
  EXPECT_EQ(glb.head.at("scenes"), json::array({json::object()}));
  EXPECT_FALSE(glb.head.contains("meshes"));
}

}  // namespace
}  // namespace farlod
