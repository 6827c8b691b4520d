// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
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

/// The template that instances have.
std::string templates_of(const std::string& geometry) {
  return R"("geometry-templates":{"templates":[)" + geometry + R"(],"vertices-templates":[[0,0,0],[1,0,0],[0,0,1]]},)";
}
std::string instance_at(int vertex, const std::string& matrix = "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1") {
  return R"({"type":"GeometryInstance","template":0,"boundaries":[)" + std::to_string(vertex) + R"(],"transformationMatrix":[)" +
         matrix + "]}";
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
  const std::string instance = instance_at(2, "0,-2,0,0,2,0,0,0,0,0,2,0,0,0,0,1");
  const std::string templates = templates_of(surface("2", "[[[0,1,2]]]"));
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

TEST(CityJson, OtherThemesAreCounted) {
  std::string objects = building(surface("2", "[[[0,1,2]]]"));
  for (const char* object : {R"("v1":{"type":"SolitaryVegetationObject"})", R"("v2":{"type":"SolitaryVegetationObject"})",
                             R"("w":{"type":"WaterBody"})", R"("n":{"type":"+NoiseWall"})", R"("r":{"type":"BuildingRoom"})"})
    objects += std::string(",") + object;
  const Reading r = read_text("a.city.json", file_of(objects));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.source.skipped,
            (SkippedFeatures{{"+NoiseWall", 1}, {"BuildingRoom", 1}, {"SolitaryVegetationObject", 2}, {"WaterBody", 1}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityJson, BridgesTunnelsAndWallsHideTheSkyToo) {
  const std::string geometry = R"(,"geometry":[)" + surface("2", "[[[0,1,4]]]") + "]}";
  const std::string objects = R"("b":{"type":"Bridge","children":["d"])" + geometry + R"(,"d":{"type":"BridgePart")" + geometry +
                              R"(,"t":{"type":"Tunnel","children":["p"])" + geometry + R"(,"p":{"type":"TunnelInstallation")" +
                              geometry + R"(,"w":{"type":"OtherConstruction")" + geometry;
  const Reading r = read_text("a.city.json", file_of(objects));
  ASSERT_EQ(r.city().buildings().size(), 3u);
  EXPECT_EQ(r.city().buildings()[0].id, "b");
  EXPECT_EQ(r.city().buildings()[1].id, "t");
  EXPECT_EQ(r.city().buildings()[2].id, "w");
  EXPECT_TRUE(r.source.skipped.empty());
}

TEST(CityJson, ABridgeMayConsistOfItsElements) {
  const std::string element = R"("e":{"type":"BridgeConstructiveElement","geometry":[)" + surface("2", "[[[0,1,4]]]") + "]}";
  const Reading r = read_text("a.city.json", file_of(R"("b":{"type":"Bridge","children":["e"]},)" + element));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().facets()[0].part, 0);
  // Beside a deck of a coarser level they follow it
  const std::string deck = R"("b":{"type":"Bridge","children":["e"],"geometry":[)" + surface("1", "[[[0,1,2]]]") + "]},";
  EXPECT_EQ(read_text("b.city.json", file_of(deck + element)).city().facets().size(), 1u);
}

TEST(CityJson, ReliefIsGroundOfTheBestLevel) {
  const std::string relief =
      R"("t":{"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":"1","boundaries":[[[0,1,4]]]},)"
      R"({"type":"CompositeSurface","lod":"2","boundaries":[[[0,1,2]],[[0,2,3]]]}]})";
  for (const std::string& objects : {relief, building(surface("2", "[[[0,1,4]]]")) + "," + relief}) {
    const Reading r = read_text("a.city.json", file_of(objects));
    EXPECT_EQ(r.source.relief_points, (std::vector<Point3d>{{10, 20, 30}, {11, 20, 30}, {11, 21, 30}, {10, 21, 30}}));
    EXPECT_EQ(r.city().buildings().size(), objects == relief ? 0u : 1u);
    EXPECT_TRUE(r.codes().empty());
  }
}

TEST(CityJson, ReliefWithCornersThatAreNoneIsReported) {
  const std::string relief =
      R"("t":{"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":"1","boundaries":[[[0,1,9]],[[0,-1,2]]]}]})";
  const Reading r = read_text("a.city.json", file_of(relief));
  EXPECT_EQ(r.source.relief_points.size(), 3u);
  EXPECT_EQ(r.codes(), std::set<int>{110});
}

TEST(CityJson, EachVersionSaysItsReferenceSystemInItsOwnWay) {
  const std::string rest = R"("CityObjects":{)" + building(surface("2", "[[[0,1,2]]]")) + "}," + vertices + "}";
  const std::vector<std::pair<std::string, std::string>> ways{
      {R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"})",
       "https://www.opengis.net/def/crs/EPSG/0/7415"},
      {R"("metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::7415"})", "urn:ogc:def:crs:EPSG::7415"},
      {R"("metadata":{"referenceSystem":7415})", "EPSG:7415"},
      {R"("metadata":{"crs":{"epsg":7415}})", "EPSG:7415"},
      {R"("crs":{"epsg":7415})", "EPSG:7415"},
      {R"("crs":{"type":"name","properties":{"name":"EPSG:7415"}})", "EPSG:7415"},
      {R"("metadata":{"referenceSystem":null,"crs":"EPSG:7415"})", "EPSG:7415"},
      {R"("metadata":{"referenceSystem":[1]})", ""},
      {R"("metadata":7)", ""}};
  for (const auto& [way, definition] : ways)
    EXPECT_EQ(read_text("a.city.json", R"({"type":"CityJSON",)" + way + "," + rest).source.crs.definition, definition) << way;
}

TEST(CityJson, CirclesOfParentsAreNotLost) {
  const std::string geometry = R"("geometry":[)" + surface("2", "[[[0,1,4]]]") + "]}";
  const std::string objects =
      R"("a":{"type":"BuildingPart","parents":["b"],)" + geometry + R"(,"b":{"type":"BuildingPart","parents":["a"],)" + geometry;
  const Reading r = read_text("a.city.json", file_of(objects));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].id, "a");
}

TEST(CityJson, APartBelongsToOneBuilding) {
  const std::string shared = R"("p":{"type":"BuildingPart","geometry":[)" + surface("2", "[[[0,1,4]]]") + "]}";
  const std::string own = R"("geometry":[)" + surface("2", "[[[0,1,2]]]") + "]}";
  const Reading r = read_text("a.city.json", file_of(R"("a":{"type":"Building","children":["p"],)" + own +
                                                     R"(,"b":{"type":"Building","children":["p"],)" + own + "," + shared));
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().facets().size(), 3u);
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

TEST(CityJson, ASequenceMayBeginWithAnIndentedText) {
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"b","CityObjects":{)" + building(surface("2", "[[[0,1,2]]]")) + "}," + vertices + "}";
  const Reading r =
      read_text("a.jsonl", "{\n \"type\": \"CityJSON\",\n \"CityObjects\": {},\n \"vertices\": []\n}\r\n" + feature);
  EXPECT_EQ(r.city().buildings().size(), 1u);
}

TEST(CityJson, LevelZeroIsRaisedByTheMeasuredHeight) {
  IngestSettings settings;
  settings.lod.exactly = 0;
  const Reading r = read_text(
      "a.city.json", file_of(building(surface("0", "[[[0,1,2,3]]]"), R"(,"attributes":{"measuredHeight":5})")), settings);
  EXPECT_EQ(surface_count(r.city()), 6u);
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

/// What is deeper than any city is refused before a tree of it would overflow the stack.
TEST(CityJson, NestingHasAnEnd) {
  constexpr std::size_t depth = 1'000'000;
  const std::string deep = std::string(depth, '[') + std::string(depth, ']');
  const std::string semantics = surface("2", "[[[0,1,2]]]", R"(,"semantics":{"surfaces":[],"values":)" + deep + "}");
  EXPECT_THROW((void)read_text("a.city.json", file_of(building(semantics))), InputError);
  EXPECT_THROW((void)read_text("b.city.json", R"({"CityObjects":{},"vertices":[],"type":)" + deep + "}"), InputError);
}

/// Thousands of instances of thousands of polygons without corners: nothing of it fills the memory, but all is gone through.
TEST(CityJson, TemplatesThatWouldTakeTheSquareOfTheFileAreRefused) {
  std::string polygons = "[]", instances;
  for (int k = 1; k < 20'000; ++k) polygons += ",[]";
  for (int k = 0; k < 2'000; ++k) instances += (k == 0 ? "" : ",") + instance_at(0);
  const std::string templates = templates_of(surface("2", "[" + polygons + "]"));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_text("a.city.json", file_of(building(instances), templates)); }),
              testing::HasSubstr("Split it into tiles"));
}

TEST(CityJson, TemplatesThatWouldFillTheMemoryAreRefused) {
  constexpr int corners = 100'000, uses = 101;
  std::string ring = "0,1,2";
  for (int k = 3; k < corners; ++k) ring += "," + std::to_string(k % 3);
  const std::string instance = instance_at(0);
  std::string instances = instance;
  for (int k = 1; k < uses; ++k) instances += "," + instance;
  const std::string templates = templates_of(surface("2", "[[[" + ring + "]]]"));
  EXPECT_THROW((void)read_text("a.city.json", file_of(building(instances), templates)), InputError);
}

}  // namespace
}  // namespace farlod::ingest::test
