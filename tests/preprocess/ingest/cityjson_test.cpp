// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"

namespace farlod::test {
namespace {

const std::string head =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/28992"},)"
    R"("transform":{"scale":[0.5,0.5,0.5],"translate":[10,20,30]},)";
const std::string vertices = R"("vertices":[[0,0,0],[2,0,0],[2,2,0],[0,2,0],[0,0,2]])";

std::string file_of(const std::string& objects, const std::string& more = "") {
  return head + R"("CityObjects":{)" + objects + "}," + more + vertices + "}";
}
std::string surface(const std::string& lod, const std::string& boundaries, const std::string& more = "") {
  return R"({"type":"MultiSurface","lod":)" + lod + R"(,"boundaries":)" + boundaries + more + "}";
}
std::string building(const std::string& geometries, const std::string& more = "") {
  return R"("b":{"type":"Building","geometry":[)" + geometries + "]" + more + "}";
}

TEST(CityJson, ReadsSurfacesWithTheTransform) {
  const Reading r = read_text("a.city.json", file_of(building(surface(R"("2.2")", "[[[0,1,2,3]],[[0,1,4]]]"))));
  EXPECT_EQ(r.source.crs.definition, "https://www.opengis.net/def/crs/EPSG/0/28992");
  ASSERT_EQ(r.city().facets().size(), 2u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[2], (Point3d{11, 21, 30}));
  EXPECT_EQ(r.city().ring(r.city().facets()[1], 0)[2], (Point3d{10, 20, 31}));
}

TEST(CityJson, SemanticsTellTheKindInEverySolid) {
  const std::string semantics = R"("surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"},{"type":"OuterCeilingSurface"}])";
  const std::string solid =
      R"({"type":"Solid","lod":"2","boundaries":[[[[0,1,2]],[[0,1,4]],[[1,2,4]]]],"semantics":{)" + semantics +
      R"(,"values":[[0,1,null]]}},{"type":"MultiSolid","lod":"2","boundaries":[[[[[0,3,4]]]]],"semantics":{)" + semantics +
      R"(,"values":[[[2]]]}})";
  const Reading r = read_text("a.city.json", file_of(building(solid)));
  ASSERT_EQ(r.city().facets().size(), 4u);
  EXPECT_EQ(r.city().facets()[0].kind, SurfaceKind::floor);
  EXPECT_EQ(r.city().facets()[1].kind, SurfaceKind::roof);
  EXPECT_EQ(r.city().facets()[2].kind, SurfaceKind::unknown);
  EXPECT_EQ(r.city().facets()[3].kind, SurfaceKind::floor);
}

TEST(CityJson, OneLevelOfDetailCounts) {
  const std::string text = file_of(building(surface(R"("1.2")", "[[[0,1,2]]]") + "," + surface("2", "[[[0,1,2]],[[0,1,4]]]") +
                                            "," + surface("0", "[[[0,1,2]]]")));
  EXPECT_EQ(read_text("a.city.json", text).city().facets().size(), 2u);
  IngestSettings settings;
  settings.lod.exactly = 1;
  EXPECT_EQ(read_text("a.city.json", text, settings).city().facets().size(), 1u);
}

TEST(CityJson, PartsBelongToTheirBuildingWhicheverSideSaysSo) {
  const std::string part = R"(,"p":{"type":"BuildingPart","geometry":[)" + surface("2", "[[[0,1,4]]]") + "]";
  const std::string root = surface("2", "[[[0,1,2]]]");
  for (const std::string& text :
       {building(root, R"(,"children":["p"])") + part + "}", building(root) + part + R"(,"parents":["b"]})"}) {
    const Reading r = read_text("a.city.json", file_of(text));
    ASSERT_EQ(r.city().buildings().size(), 1u);
    EXPECT_EQ(r.city().facets()[1].part, 1);
    EXPECT_TRUE(r.codes().empty());
  }
}

TEST(CityJson, TemplatesAreTurnedAndMoved) {
  const std::string instance =
      R"({"type":"GeometryInstance","template":0,"boundaries":[2],"transformationMatrix":[0,-2,0,0,2,0,0,0,0,0,2,0,0,0,0,1]})";
  const std::string templates = R"("geometry-templates":{"templates":[)" + surface("2", "[[[0,1,2]]]") +
                                R"(],"vertices-templates":[[0,0,0],[1,0,0],[0,0,1]]},)";
  const Reading r = read_text("a.city.json", file_of(building(instance), templates));
  const auto ring = r.city().ring(r.city().facets()[0], 0);
  EXPECT_EQ(std::vector<Point3d>(ring.begin(), ring.end()), (std::vector<Point3d>{{11, 21, 30}, {11, 23, 30}, {11, 21, 32}}));
}

TEST(CityJson, BuildingsKeepTheOrderOfTheFileAndEqualIdsSurvive) {
  const std::string b = building(surface("2", "[[[0,1,2]]]"));
  const Reading r = read_text("a.city.json", file_of(R"("z)" + b.substr(1) + "," + b + "," + b));
  ASSERT_EQ(r.city().buildings().size(), 3u);
  EXPECT_EQ(r.city().buildings()[0].id, "zb");
  EXPECT_EQ(r.codes(), std::set<int>{106});
}

TEST(CityJson, OtherThemesAreNotBuildings) {
  const std::string objects = building(surface("2", "[[[0,1,2]]]")) + R"(,"t":{"type":"TINRelief","geometry":[)" +
                              surface("1", "[[[0,1,2]]]") + R"(]},"bridge":{"type":"Bridge","geometry":[)" +
                              surface("2", "[[[0,1,4]]]") + "]}";
  EXPECT_EQ(read_text("a.city.json", file_of(objects)).city().buildings().size(), 2u);
}

TEST(CityJson, TheTypeMayComeLastAndTheEndingBeJson) {
  const std::string text =
      R"({"CityObjects":{)" + building(surface("2", "[[[0,1,2]]]")) + "}," + vertices + R"(,"type":"CityJSON","version":"1.0"})";
  EXPECT_EQ(read_text("a.json", text).city().ring(read_text("a.json", text).city().facets()[0], 0)[2], (Point3d{2, 2, 0}));
}

TEST(CityJson, ASequenceIsReadLineByLine) {
  const std::string first = head + R"("CityObjects":{},"vertices":[]})";
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"b","CityObjects":{)" + building(surface("2", "[[[0,1,2]]]")) + "}," + vertices + "}";
  const Reading r = read_text("a.city.jsonl", first + "\n" + feature + "\n{broken\n");
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[1], (Point3d{11, 20, 30}));
  EXPECT_EQ(r.codes(), std::set<int>{113});
}

TEST(CityJson, LevelZeroIsRaisedByTheMeasuredHeight) {
  IngestSettings settings;
  settings.lod.exactly = 0;
  const Reading r = read_text(
      "a.city.json", file_of(building(surface("0", "[[[0,1,2,3]]]"), R"(,"attributes":{"measuredHeight":5})")), settings);
  EXPECT_EQ(r.city().surface_count(), 6u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 35.0);
}

TEST(CityJson, AHeightThatIsLostBesideTheElevationIsNone) {
  IngestSettings settings;
  settings.lod.exactly = 0;
  const std::string good =
      R"("good":{"type":"Building","attributes":{"measuredHeight":5},"geometry":[)" + surface("0", "[[[0,1,2]]]") + "]},";
  const std::string flat = building(surface("0", "[[[0,1,2]]]"), R"(,"attributes":{"measuredHeight":1e-20})");
  const Reading r = read_text("a.city.json", file_of(good + flat), settings);
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].id, "good");
  EXPECT_EQ(r.codes(), (std::set<int>{109, 111}));
}

TEST(CityJson, AVertexNumberThatIsNotWholeCostsItsBuilding) {
  const std::string good = R"("good":{"type":"Building","geometry":[)" + surface("2", "[[[0,1,2]]]") + "]},";
  for (const std::string number : {"1.0", "1.5", "true", "1e300", "218446744073709551615"}) {
    const Reading r = read_text("a.city.json", file_of(good + building(surface("2", "[[[0," + number + ",2]]]"))));
    EXPECT_EQ(r.city().buildings().size(), 1u) << number;
    EXPECT_EQ(r.codes(), (std::set<int>{111, 113})) << number;
  }
}

TEST(CityJson, PartsMayBeNestedDeeperThanTheStack) {
  constexpr int depth = 100'000;  // calls, each of a hundred bytes or more, overflow the usual 8 MiB
  std::string objects = building("", R"(,"children":["p1"])");
  for (int k = 1; k < depth; ++k)
    objects += ",\"p" + std::to_string(k) + R"(":{"type":"BuildingPart","children":["p)" + std::to_string(k + 1) + "\"]}";
  objects += ",\"p" + std::to_string(depth) + R"(":{"type":"BuildingPart","geometry":[)" + surface("2", "[[[0,1,2]]]") + "]}";
  const Reading r = read_text("a.city.json", file_of(objects));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().facets().size(), 1u);
  EXPECT_TRUE(r.codes().empty());
}

}  // namespace
}  // namespace farlod::test
