// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_building.hpp"
#include "ingest/citygml/citygml_vocabulary.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

const std::string outside = "<con:relationToConstruction>outside</con:relationToConstruction>";
const std::string inside = "<con:relationToConstruction>inside</con:relationToConstruction>";

TEST(CityGmlConstructions, ATunnelIsWhatOneSeesOfIt) {
  const std::string tunnel =
      "<tun:Tunnel>" + within("tun:boundedBy tun:RoofSurface", surface("tun:lod2MultiSurface", "r", "1")) +
      within("tun:boundedBy tun:InteriorWallSurface", surface("tun:lod2MultiSurface", "i", "2")) +
      within("tun:outerTunnelInstallation tun:TunnelInstallation", surface("tun:lod2Geometry", "portal", "3")) +
      within("tun:interiorHollowSpace tun:HollowSpace", surface("tun:lod2MultiSurface", "hollow", "4")) +
      within("tun:interiorTunnelInstallation tun:IntTunnelInstallation", surface("tun:lod2Geometry", "lamp", "5")) +
      within("tun:consistsOfTunnelPart tun:TunnelPart", surface("tun:lod2MultiSurface", "p", "6")) + "</tun:Tunnel>";
  const Reading r = read_citygml_text(model("<cityObjectMember>" + tunnel + "</cityObjectMember>"));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(heights(r.city()), (std::vector<double>{1, 3, 6}));
  EXPECT_EQ(r.city().facets()[0].kind, SurfaceKind::roof);
  EXPECT_EQ(r.city().facets()[2].part, 1u);
  EXPECT_TRUE(r.codes().empty());
  EXPECT_TRUE(r.source.skipped.empty());
}

TEST(CityGmlConstructions, APartThatStandsAloneIsABuilding) {
  const std::string part = within("cityObjectMember tun:TunnelPart", surface("tun:lod1MultiSurface", "a", "1"));
  EXPECT_EQ(read_citygml_text(model(part)).city().buildings().size(), 1u);
}

TEST(CityGmlConstructions, OtherConstructionsStandOnTheirOwn) {
  const std::string wall = within("cityObjectMember con:OtherConstruction", surface("core:lod2MultiSurface", "a", "1"));
  const std::string generic = within("cityObjectMember gen:GenericOccupiedSpace", surface("core:lod2MultiSurface", "b", "2"));
  const Reading r = read_citygml_text(model_3(wall + generic));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"GenericOccupiedSpace", 1}}));
}

TEST(CityGmlConstructions, BuildingsOfVersion3) {
  const std::string window = within("con:fillingSurface con:WindowSurface", surface("core:lod3MultiSurface", "w", "2"));
  const std::string house =
      "<bldg:Building>" + within("core:boundary con:RoofSurface", surface("core:lod3MultiSurface", "r", "1") + window) +
      within("bldg:buildingInstallation bldg:BuildingInstallation",
             within("core:boundary con:WallSurface", surface("core:lod3MultiSurface", "i", "3")) + outside) +
      within("bldg:buildingConstructiveElement bldg:BuildingConstructiveElement",
             within("core:lod3Solid gml:Solid gml:exterior gml:Shell", member(polygon("e", "4")))) +
      within("bldg:buildingPart bldg:BuildingPart", surface("core:lod3MultiSurface", "p", "5")) +
      within("bldg:buildingRoom bldg:BuildingRoom", surface("core:lod3MultiSurface", "room", "6")) +
      within("bldg:buildingFurniture bldg:BuildingFurniture", surface("core:lod3MultiSurface", "chair", "7")) +
      within("bldg:buildingSubdivision bldg:Storey", surface("core:lod3MultiSurface", "storey", "8")) + "</bldg:Building>";
  const Reading r = read_citygml_text(model_3(within("cityObjectMember", house)));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(r.city().facets()[1].kind, SurfaceKind::wall) << "windows are walls";
  EXPECT_EQ(r.city().facets()[4].part, 1u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlConstructions, WhatStandsInsideSaysSoBehindItsGeometry) {
  const auto installation = [](const std::string& id, const std::string& z, const std::string& relation) {
    return within("bldg:buildingInstallation bldg:BuildingInstallation", surface("core:lod2MultiSurface", id, z) + relation);
  };
  const std::string house = "<bldg:Building>" + surface("core:lod2MultiSurface", "a", "1") + installation("in", "2", inside) +
                            installation("out", "3", outside) + installation("unsaid", "4", "") + "</bldg:Building>";
  EXPECT_EQ(heights(read_citygml_text(model_3(within("cityObjectMember", house))).city()), (std::vector<double>{3, 4, 1}));
}

TEST(CityGmlConstructions, ABridgeMayConsistOfPylonsAndDecks) {
  const std::string pylons = within("brid:outerBridgeConstruction brid:BridgeConstructionElement",
                                    surface("brid:lod2Geometry", "c2", "2") + surface("brid:lod1Geometry", "c1", "1"));
  EXPECT_EQ(heights(read_citygml_text(model(within("cityObjectMember brid:Bridge", pylons))).city()), std::vector<double>{2});
  // Where the bridge has surfaces of its own, they decide the level of detail
  const std::string deck = surface("brid:lod1MultiSurface", "d", "5");
  EXPECT_EQ(heights(read_citygml_text(model(within("cityObjectMember brid:Bridge", pylons + deck))).city()),
            (std::vector<double>{1, 5}));
}

TEST(CityGmlConstructions, LevelZeroOfVersion3IsToldByItsSurfaces) {
  const std::string height = within("con:height con:Height", R"(<con:value uom="m">4</con:value>)");
  const std::string ground = within("core:boundary con:GroundSurface", surface("core:lod0MultiSurface", "g", "3"));
  const std::string roof = within("core:boundary con:RoofSurface", surface("core:lod0MultiSurface", "r", "10"));
  const std::string wall = within("core:boundary con:WallSurface", surface("core:lod0MultiSurface", "w", "20"));
  const auto top_and_floor = [&](const std::string& content) {
    const Reading r = read_citygml_text(model_3(within("cityObjectMember bldg:Building", height + content)), LodChoice{0});
    EXPECT_EQ(surface_count(r.city()), 5u);
    return std::pair(heights(r.city()).front(), heights(r.city()).back());
  };
  EXPECT_EQ(top_and_floor(ground + wall), std::pair(7.0, 3.0));
  EXPECT_EQ(top_and_floor(roof), std::pair(10.0, 6.0));
  EXPECT_EQ(top_and_floor(roof + ground), std::pair(7.0, 3.0)) << "the footprint goes before the roof edge";
  EXPECT_EQ(top_and_floor(surface("core:lod0MultiSurface", "b", "2")), std::pair(6.0, 2.0));
}

TEST(CityGmlConstructions, TheSameHouseInAllThreeVersions) {
  std::string text = model(building(bounded_by("RoofSurface", multi_surface("2", member(polygon("r", "6"))))));
  const auto replace_all = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  };
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
  replace_all("/2.0\"", "/1.0\"");
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
  replace_all("/1.0\"", "/3.0\"");
  replace_all("opengis.net/gml\"", "opengis.net/gml/3.2\"");
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
}

const std::string matrix_turned = "0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1";  // a quarter turn, twice as large, moved by 1, 2, 3

std::string matrix(const std::string& numbers) { return within("core:transformationMatrix", numbers); }
std::string reference_point(const std::string& position) { return within("core:referencePoint gml:Point gml:pos", position); }
std::string prototype(const std::string& id) {
  return R"(<core:relativeGMLGeometry><gml:MultiSurface gml:id=")" + id + R"(">)" + member(polygon(id + "_polygon", "5")) +
         "</gml:MultiSurface></core:relativeGMLGeometry>";
}
std::string dormer(const std::string& content) {
  return within("bldg:outerBuildingInstallation bldg:BuildingInstallation bldg:lod2ImplicitRepresentation core:ImplicitGeometry",
                content);
}
const std::string walls = surface("bldg:lod2MultiSurface", "walls", "0");

std::vector<Point3d> first_ring(const CityModel& city) {
  const auto ring = city.ring(city.facets()[0], 0);
  return {ring.begin(), ring.end()};
}

TEST(CityGmlPrototypes, AMatrixTurnsAndAPointMoves) {
  const Reading r = read_citygml_text(
      model(building(dormer(matrix(matrix_turned) + prototype("p") + reference_point("1000 2000 30")) + walls)));
  ASSERT_EQ(r.city().facets().size(), 2u);
  // (0 0 5), (9 0 5), (9 9 5): x' = -2y + 1 + 1000, y' = 2x + 2 + 2000, z' = 2z + 3 + 30
  EXPECT_EQ(first_ring(r.city()), (std::vector<Point3d>{{1001, 2002, 43}, {1001, 2020, 43}, {983, 2020, 43}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlPrototypes, APrototypeIsThereOnceForEachOfItsPlaces) {
  const std::string again = R"(<core:relativeGMLGeometry xlink:href="#p"/>)";
  const std::string first = dormer(prototype("p") + reference_point("1000 2000 30"));
  const std::string second = dormer(again + reference_point("1000 2000 40"));
  const Reading r = read_citygml_text(model(building(first + second + walls) + building(second + walls, "neighbor")));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{35, 45, 0, 45, 0})) << "the neighbor refers to another building's";
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlPrototypes, ThePlacesOfAPrototypeAreNoCopiesOfEachOther) {
  const auto placed = [](const std::string& geometry, const std::string& position) {
    return within("bldg:lod2ImplicitRepresentation core:ImplicitGeometry", geometry + reference_point(position));
  };
  const std::string again = R"(<core:relativeGMLGeometry xlink:href="#p"/>)";
  const Reading r = read_citygml_text(model(building(placed(prototype("p"), "1000 2000 30") + placed(again, "1000 2000 40"))));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{35, 45}));
}

TEST(CityGmlPrototypes, Version3NamesItOtherwise) {
  const std::string text = within(
      "cityObjectMember brid:Bridge brid:bridgeConstructiveElement brid:BridgeConstructiveElement "
      "core:lod1ImplicitRepresentation "
      "core:ImplicitGeometry",
      matrix("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") + reference_point("1000 2000 30") + surface("core:relativeGeometry", "p", "7"));
  EXPECT_EQ(heights(read_citygml_text(model_3(text)).city()), std::vector<double>{37});
}

TEST(CityGmlPrototypes, AMirrorKeepsOutsideOutside) {
  const Reading r = read_citygml_text(model(
      building(dormer(matrix("-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") + prototype("p") + reference_point("1000 2000 30")) + walls)));
  EXPECT_GT(double_area_vector(r.city(), r.city().facets()[0]).z, 0.0);
}

/// What is said of a dormer that cannot be placed; the house remains.
std::string said_of(const std::string& content) {
  const Reading r = read_citygml_text(model(building(dormer(content) + walls)));
  EXPECT_EQ(r.city().facets().size(), 1u);
  EXPECT_EQ(r.codes(), std::set<int>{112});
  return r.report.problems().size() == 1 ? r.report.problems()[0].detail : "";
}

TEST(CityGmlPrototypes, WhatCannotBePlacedIsReported) {
  const std::string place = reference_point("1000 2000 30");
  EXPECT_NE(said_of(prototype("p") + reference_point("139.7 35.6 30")).find("degrees"), std::string::npos);
  EXPECT_NE(said_of(prototype("p")).find("referencePoint"), std::string::npos);
  EXPECT_NE(said_of(prototype("p") + reference_point("1000 2000")).find("referencePoint"), std::string::npos);
  EXPECT_NE(said_of(matrix("1 2 3") + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of(matrix(matrix_turned + " 1") + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of(matrix("x" + matrix_turned.substr(1)) + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of("<core:libraryObject>http://a/tree.dae</core:libraryObject>" + place).find("libraryObject"),
            std::string::npos);
  EXPECT_NE(said_of("").find("lod2ImplicitRepresentation"), std::string::npos);
}

TEST(CityGmlPrototypes, NumbersWithinNumbersAreNone) {
  EXPECT_NE(said_of("<core:transformationMatrix>1<gml:pos>1 2 3</gml:pos>2</core:transformationMatrix>" + prototype("p") +
                    reference_point("1000 2000 30"))
                .find("16 numbers"),
            std::string::npos);
}

std::string triangle(const std::string& z) { return within("gml:Triangle gml:exterior", ring(z)); }
std::string tin(const std::string& content) {
  return within("cityObjectMember dem:ReliefFeature dem:reliefComponent dem:TINRelief dem:tin", content);
}
const std::vector<Point3d> corners_at_5{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}};

TEST(CityGmlRelief, ATerrainAloneIsACityWithoutBuildings) {
  const std::string text = tin(within("gml:TriangulatedSurface gml:trianglePatches", triangle("5")));
  for (const std::string& file : {model(text), model_3(text)}) {
    const Reading r = read_citygml_text(file);
    EXPECT_TRUE(r.city().buildings().empty());
    EXPECT_EQ(r.source.relief_points, corners_at_5) << "without the point that closes the ring";
    EXPECT_TRUE(r.source.skipped.empty());
    EXPECT_TRUE(r.codes().empty());
  }
}

TEST(CityGmlRelief, TrianglesBelongToNoBuilding) {
  const std::string text = tin(within("gml:TriangulatedSurface gml:trianglePatches", triangle("5")));
  const Reading r = read_citygml_text(model(text + building(surface("bldg:lod1MultiSurface", "a", "1")) + text));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.relief_points.size(), 6u);
}

TEST(CityGmlRelief, ATinIsGivenByItsControlPointsToo) {
  const std::string text =
      tin("<gml:Tin><gml:boundedBy><gml:Envelope><gml:pos>77 77 77</gml:pos></gml:Envelope></gml:boundedBy>" +
          within("gml:trianglePatches", "") + within("gml:maxLength", "10") +
          within("gml:controlPoint gml:posList", "0 0 5 9 0 5\n 9 9 5") + "</gml:Tin>");
  EXPECT_EQ(read_citygml_text(model(text)).source.relief_points, corners_at_5);
}

TEST(CityGmlRelief, MassPointsAreRead) {
  std::string points;
  for (const char* position : {"0 0 5", "9 0 5", "9 9 5"}) points += within("gml:pointMember gml:Point gml:pos", position);
  const std::string text = within("cityObjectMember dem:MassPointRelief dem:reliefPoints gml:MultiPoint", points);
  EXPECT_EQ(read_citygml_text(model(text)).source.relief_points, corners_at_5);
}

TEST(CityGmlRelief, RastersAreCounted) {
  const std::string raster = within("dem:reliefComponent dem:RasterRelief dem:grid", "");
  const std::string lines =
      within("dem:reliefComponent dem:BreaklineRelief dem:breaklines gml:LineString gml:posList", "0 0 0 1 1 1");
  const Reading r = read_citygml_text(
      model(within("cityObjectMember dem:ReliefFeature", raster + lines) + building(surface("bldg:lod1MultiSurface", "a", "1"))));
  EXPECT_TRUE(r.source.relief_points.empty());
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"BreaklineRelief", 1}, {"RasterRelief", 1}}));
}

TEST(CityGmlRelief, UnreadablePointsAreLeftOut) {
  const std::string lists =
      within("gml:controlPoint gml:posList", "0 0 5 9 x 5 9 9 1e300 9 0 5 9") + within("gml:controlPoint gml:posList", "9 9 5");
  const Reading r = read_citygml_text(model(tin("<gml:Tin>" + lists + "</gml:Tin>")));
  EXPECT_EQ(r.source.relief_points, corners_at_5);
  ASSERT_EQ(r.codes(), std::set<int>{102});
  EXPECT_NE(r.report.problems()[0].detail.find(": 3"), std::string::npos) << r.report.problems()[0].detail;
  const std::string flat =
      R"(<gml:Tin><gml:controlPoint><gml:posList srsDimension="2">0 0 9 9</gml:posList></gml:controlPoint></gml:Tin>)";
  const Reading both = read_citygml_text(model(tin(flat) + tin("<gml:Tin>" + within("gml:pos", "0 0 5") + "</gml:Tin>")));
  EXPECT_EQ(both.source.relief_points.size(), 1u) << "the dimension of one terrain is not that of the next";
}

TEST(CityGmlRelief, ARealFileHasHouseAndGround) {
  FARLOD_NEEDS_DATA("formats");
  Reading r;
  r.source = read_citygml(shared_data("formats/Building_LOD3-EPSG25832.gml"), {}, r.report);
  EXPECT_EQ(surface_count(r.city()), 24u);
  ASSERT_EQ(r.source.relief_points.size(), 27u) << "nine triangles";
  EXPECT_EQ(r.source.relief_points[2], (Point3d{458883, 5438362, 114}));
}

const std::string skipped_house = building(surface("bldg:lod1MultiSurface", "a", "1"));

TEST(CityGmlSkipped, ObjectsOfOtherThemesAreCountedByName) {
  const std::string tree = within("cityObjectMember veg:SolitaryVegetationObject", surface("veg:lod2Geometry", "t", "9"));
  const std::string hedge = within("cityObjectMember veg:PlantCover", surface("veg:lod2MultiSurface", "h", "9"));
  const std::string relic = within("cityObjectMember uro:Relic uro:lod2Solid", polygon("r", "9"));
  const Reading r = read_citygml_text(model(tree + skipped_house + hedge + tree + relic));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"PlantCover", 1}, {"Relic (urn:some:ade)", 1}, {"SolitaryVegetationObject", 2}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlSkipped, ExtensionsWithinABuildingAreCountedWhereTheyBegin) {
  const std::string extension = within("uro:floods uro:Flood uro:depth", "3");
  const std::string generics = within("core:externalReference core:informationSystem", "x");
  const Reading r =
      read_citygml_text(model(building(extension + generics + extension + surface("bldg:lod1MultiSurface", "a", "1"))));
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"floods (urn:some:ade)", 2}}));
}

TEST(CityGmlSkipped, ABuildingWithinAGroupIsStillABuilding) {
  const std::string group =
      within("cityObjectMember core:CityObjectGroup core:groupMember bldg:Building", surface("bldg:lod1MultiSurface", "a", "1"));
  const Reading r = read_citygml_text(model(group));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"CityObjectGroup", 1}}));
}

TEST(CityGmlSkipped, ThereIsAnEndToNames) {
  std::string members;
  for (std::size_t k = 0; k < 2 * SkippedCount::most_names; ++k)
    members += within("cityObjectMember", "<uro:Thing" + std::to_string(k) + "/>");
  members += within("cityObjectMember", "<uro:Thing0/>");
  const std::string long_name = "uro:" + std::string(10'000, 'x');
  const Reading r = read_citygml_text(model(within("cityObjectMember", "<" + long_name + "/>") + members + skipped_house));
  EXPECT_EQ(r.source.skipped.size(), SkippedCount::most_names + 1);
  EXPECT_EQ(r.source.skipped.at(SkippedCount::other_names), SkippedCount::most_names + 1);
  EXPECT_EQ(r.source.skipped.at("Thing0 (urn:some:ade)"), 2u);
  for (const auto& [name, count] : r.source.skipped) EXPECT_LT(name.size(), 250u);
}

TEST(CityGmlSkipped, ACutNameKeepsWholeCharacters) {
  SkippedCount count;
  std::string name = "x";
  for (int k = 0; k < 200; ++k) name += "é";
  count.add({.space = "", .name = name, .id = {}, .href = {}, .srs_name = {}, .srs_dimension = {}, .orientation = {}});
  EXPECT_EQ(count.counts().begin()->first, name.substr(0, 199) + "...");
}

TEST(CityGmlSkipped, AFileOfOtherThemesSaysWhatItHas) {
  const std::string refusal =
      scenes::refusal_of<InputError>([&] { (void)read_citygml_text(model(within("cityObjectMember veg:PlantCover", ""))); });
  EXPECT_NE(refusal.find("holds no Building"), std::string::npos);
  EXPECT_NE(refusal.find("1 PlantCover"), std::string::npos);
}

}  // namespace
}  // namespace farlod::ingest::test
