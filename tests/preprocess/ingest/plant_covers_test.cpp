// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"
#include "tree_reading.hpp"

namespace farlod::ingest::test {
namespace {

std::string ring(const std::string& coordinates) {
  return "<gml:LinearRing><gml:posList>" + coordinates + "</gml:posList></gml:LinearRing>";
}
std::string citygml_cover(const std::string& inside, const std::string& outer, const std::string& hole = "") {
  return "<veg:PlantCover>" + inside + "<veg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior>" +
         ring(outer) + "</gml:exterior>" + (hole.empty() ? "" : "<gml:interior>" + ring(hole) + "</gml:interior>") +
         "</gml:Polygon></gml:surfaceMember></gml:MultiSurface></veg:lod1MultiSurface></veg:PlantCover>";
}
std::string average_height(const std::string& height) { return "<veg:averageHeight>" + height + "</veg:averageHeight>"; }
const std::string eight_by_four = "10 20 5 18 20 5 18 24 5 10 24 5 10 20 5";

/// Of all squares together.
double area_of(const TreeReading& r) {
  double area = 0.0;
  for (const Tree& t : r.trees()) area += double{t.crown_diameter_m} * double{t.crown_diameter_m};
  return area;
}

TEST(PlantCovers, AreSquaresFromTheGroundToTheirHeight) {
  const TreeReading r = read_inventory("a.gml", citygml(citygml_cover(average_height("6"), eight_by_four)));
  // As wide as a strip of the same area and outline: 2 · 32 m²/24 m. A quarter of it is the edge
  ASSERT_EQ(r.source.trees.size(), 12U * 6U);
  EXPECT_NEAR(area_of(r), 32.0, 1e-5);
  Box2d centres;
  for (const Tree& t : r.trees()) {
    EXPECT_EQ(t.shape, CrownShape::prism);
    EXPECT_EQ(t.height_m, 6.0F);
    EXPECT_EQ(t.trunk_height_m, 0.0F);
    centres.add(t.place);
  }
  EXPECT_NEAR(centres.low.x, 10.0 + 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(centres.high.y, 24.0 - 1.0 / 3.0, 1e-9);
  EXPECT_EQ(r.codes(), std::set<int>{});
}

TEST(PlantCovers, HaveHoles) {
  const std::string outer = "0 0 0 40 0 0 40 40 0 0 40 0", hole = "10 10 0 10 30 0 30 30 0 30 10 0";
  const TreeReading r = read_inventory("a.gml", citygml(citygml_cover(average_height("6"), outer, hole)));
  EXPECT_EQ(r.source.trees[0].crown_diameter_m, 2.0F);
  EXPECT_NEAR(area_of(r), 40.0 * 40.0 - 20.0 * 20.0, 1e-5);
}

TEST(PlantCovers, ThatAreGroundCoverBecomeNothing) {
  const std::string tree = citygml_tree("<veg:lod1Geometry><gml:posList>10 20 5 14 26 12</gml:posList></veg:lod1Geometry>");
  const TreeReading r = read_inventory(
      "a.gml", citygml(tree + citygml_cover("", eight_by_four) + citygml_cover(average_height("1.9"), eight_by_four) +
                       citygml_cover(average_height("0"), eight_by_four) +
                       citygml_cover(average_height("6"), "13.01 52 5 13.02 52 5 13.02 52.01 5") +
                       citygml_cover(average_height("131"), eight_by_four) + citygml_cover(average_height("6"), "0 0 0")));
  EXPECT_EQ(r.source.trees.size(), 1U);
  EXPECT_EQ(
      r.source.skipped,
      (SkippedFeatures{{"PlantCover in degrees", 1}, {"PlantCover lower than 2 m", 1}, {"PlantCover without a height", 2}}));
  EXPECT_EQ(r.codes(), (std::set<int>{111, 122}));
}

/// A solid whose floor rises by half a metre on each metre to the east, and whose roof is 5 m above it.
const std::string solid_on_a_slope =
    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[400000,5800000,0]},"CityObjects":{"wood":
    {"type":"PlantCover","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3]]]},
    {"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}},
    "vertices":[[0,0,10],[40,0,30],[40,20,30],[0,20,10],[0,0,15],[40,0,35],[40,20,35],[0,20,15]]})";

TEST(PlantCovers, AreAsHighAsTheirSolidsAreOnAverage) {
  const TreeReading r = read_inventory("a.city.json", solid_on_a_slope);
  ASSERT_EQ(r.source.trees.size(), 20U * 10U);
  EXPECT_NEAR(r.source.trees[0].height_m, 5.0, float_error_m);
  EXPECT_NEAR(area_of(r), 800.0, 1e-5);
}

TEST(PlantCovers, OfDelftHaveNoHeights) {
  FARLOD_NEEDS_DATA("delft");
  for (const auto& file : std::filesystem::directory_iterator(shared_data("delft"))) {
    if (file.path().extension() != ".json") continue;
    const std::string refusal = scenes::refusal_of<InputError>([&] { (void)read_inventory(file.path()); });
    EXPECT_NE(refusal.find("126 PlantCover without a height"), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace farlod::ingest::test
