// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

TEST(CityGml, ReadsRingsHolesAndTheReferenceSystem) {
  const std::string content =
      R"(<gml:Polygon><gml:exterior>)" + ring("5") + "</gml:exterior><gml:interior><gml:LinearRing><gml:pos>1 0 5</gml:pos>" +
      "<gml:pos>2 0 5</gml:pos><gml:pos>2 1 5</gml:pos><gml:pos>1 0 5</gml:pos></gml:LinearRing></gml:interior></gml:Polygon>";
  const Reading r = read_text("a.gml", model(building(multi_surface("2", member(content)))));
  EXPECT_EQ(r.source.crs.definition, "EPSG:25832");
  ASSERT_EQ(r.city().facets().size(), 1u);
  ASSERT_EQ(r.city().facets()[0].ring_count, 2u);
  const auto outer = r.city().ring(r.city().facets()[0], 0), hole = r.city().ring(r.city().facets()[0], 1);
  EXPECT_EQ(std::vector<Point3d>(outer.begin(), outer.end()), (std::vector<Point3d>{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}}));
  EXPECT_EQ(hole[2], (Point3d{2, 1, 5}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGml, ASolidThatRefersToSemanticSurfacesDoesNotDoubleThem) {
  const std::string content = solid("2", reference("r") + reference("w")) +
                              bounded_by("RoofSurface", multi_surface("2", member(polygon("r", "6")))) +
                              bounded_by("WallSurface", multi_surface("2", member(polygon("w", "3"))));
  const Reading r = read_text("a.gml", model(building(content)));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{6, 3}));
  EXPECT_EQ(r.city().facets()[0].kind, SurfaceKind::roof);
  EXPECT_EQ(r.city().facets()[1].kind, SurfaceKind::wall);
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGml, ASolidThatCopiesSemanticSurfacesDoesNotDoubleThem) {
  const std::string content = solid("2", member(polygon("copy", "6")) + member(polygon("only here", "3"))) +
                              bounded_by("RoofSurface", multi_surface("2", member(polygon("r", "6"))));
  EXPECT_EQ(heights(read_text("a.gml", model(building(content))).city()), (std::vector<double>{6, 3}));
}

TEST(CityGml, ASurfaceThatRefersToAnothersPolygonDoesNotDoubleIt) {
  const std::string content = bounded_by("WallSurface", multi_surface("2", member(polygon("w", "3")))) +
                              bounded_by("RoofSurface", multi_surface("2", reference("w")));
  const Reading r = read_text("a.gml", model(building(content)));
  EXPECT_EQ(heights(r.city()), std::vector<double>{3});
  EXPECT_EQ(r.city().facets()[0].kind, SurfaceKind::wall) << "the first that has it tells its kind";
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGml, OneLevelOfDetailCounts) {
  const std::string content = solid("1", member(polygon("a", "1"))) + solid("2", member(polygon("b", "2"))) + "<bldg:lod4Solid/>";
  EXPECT_EQ(heights(read_text("a.gml", model(building(content))).city()), std::vector<double>{2});
  IngestSettings settings;
  settings.lod.exactly = 1;
  EXPECT_EQ(heights(read_text("a.gml", model(building(content)), settings).city()), std::vector<double>{1});
}

TEST(CityGml, AnUnusableLevelOfDetailGivesWayToTheNext) {
  const std::string empty =
      "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList/></gml:LinearRing></gml:exterior></gml:Polygon>";
  const Reading r = read_text("a.gml", model(building(solid("1", member(polygon("a", "1"))) + solid("2", member(empty)))));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
}

TEST(CityGml, AChimneyDoesNotDecideTheLevelOfDetail) {
  const std::string chimney = "<bldg:outerBuildingInstallation><bldg:BuildingInstallation><bldg:lod2Geometry>" +
                              polygon("c2", "8") + "</bldg:lod2Geometry><bldg:lod3Geometry>" + polygon("c3", "9") +
                              "</bldg:lod3Geometry></bldg:BuildingInstallation></bldg:outerBuildingInstallation>";
  EXPECT_EQ(heights(read_text("a.gml", model(building(solid("2", member(polygon("b", "2"))) + chimney))).city()),
            (std::vector<double>{8, 2}));
}

TEST(CityGml, PartsBelongToTheirBuilding) {
  const std::string part = R"(<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id="p">)";
  const std::string end = "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const Reading r =
      read_text("a.gml", model(building(solid("2", member(polygon("a", "1"))) + part + solid("2", member(polygon("b", "2"))) +
                                        end + part + solid("2", member(polygon("c", "3"))) + end)));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  ASSERT_EQ(r.city().facets().size(), 3u);
  for (std::uint16_t k = 0; k < 3; ++k) EXPECT_EQ(r.city().facets()[k].part, k);
}

TEST(CityGml, AReferenceLeadsIntoAnotherBuildingBeforeOrBehind) {
  const std::string house = building(solid("2", member(polygon("h", "1")) + reference("shared")), "house");
  const std::string garage = building(bounded_by("WallSurface", multi_surface("2", member(polygon("shared", "4")))), "garage");
  for (const std::string& text : {house + garage, garage + house}) {
    const Reading r = read_text("a.gml", model(text));
    EXPECT_EQ(r.city().facets().size(), 3u);
    EXPECT_TRUE(r.codes().empty());
  }
}

TEST(CityGml, OrientationMinusTurnsASurface) {
  const std::string turned = R"(<gml:OrientableSurface orientation="-"><gml:baseSurface>)" + polygon("a", "1") +
                             "</gml:baseSurface></gml:OrientableSurface>";
  const Reading r = read_text("a.gml", model(building(multi_surface("2", member(polygon("up", "2")) + member(turned)))));
  ASSERT_EQ(r.city().facets().size(), 2u);
  EXPECT_GT(double_area_vector(r.city(), r.city().facets()[0]).z, 0.0);
  EXPECT_LT(double_area_vector(r.city(), r.city().facets()[1]).z, 0.0);
}

TEST(CityGml, TrianglesOfASurfaceAreRead) {
  const std::string triangle = "<gml:Triangle><gml:exterior>" + ring("1") + "</gml:exterior></gml:Triangle>";
  const std::string surface =
      "<gml:TriangulatedSurface><gml:trianglePatches>" + triangle + triangle + "</gml:trianglePatches></gml:TriangulatedSurface>";
  EXPECT_EQ(read_text("a.gml", model(building("<bldg:lod2MultiSurface>" + surface + "</bldg:lod2MultiSurface>")))
                .city()
                .facets()
                .size(),
            1u)
      << "two equal triangles of one solid are one surface told twice";
}

TEST(CityGml, NumbersThatAreNoGeometryAreNotRead) {
  const std::string decoys =
      "<bldg:lod2TerrainIntersection><gml:MultiCurve><gml:curveMember><gml:LineString><gml:posList>0 0 0 1 1 "
      "1</gml:posList></gml:LineString>"
      "</gml:curveMember></gml:MultiCurve></bldg:lod2TerrainIntersection><uro:thing><uro:lod2Solid>" +
      polygon("ade", "7") +
      "</uro:lod2Solid></uro:thing><app:appearance><app:textureCoordinates>0 0 1 1</app:textureCoordinates></app:appearance>" +
      "<bldg:interiorRoom><bldg:Room>" + solid("3", member(polygon("room", "8"))) + "</bldg:Room></bldg:interiorRoom>";
  const Reading r = read_text("a.gml", model(building(decoys + solid("2", member(polygon("a", "1"))))));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGml, LevelZeroIsRaisedByTheMeasuredHeight) {
  const std::string content = R"(<bldg:measuredHeight uom="m">4</bldg:measuredHeight><bldg:lod0RoofEdge><gml:MultiSurface>)" +
                              member(polygon("edge", "10")) + "</gml:MultiSurface></bldg:lod0RoofEdge>";
  IngestSettings settings;
  settings.lod.exactly = 0;
  const Reading r = read_text("a.gml", model(building(content)), settings);
  EXPECT_EQ(surface_count(r.city()), 5u);
  EXPECT_EQ(r.city().ring(r.city().facets().front(), 0)[0].z, 10.0);
  EXPECT_EQ(r.city().ring(r.city().facets().back(), 0)[0].z, 6.0);
}

TEST(CityGml, AnEndlessHeightRaisesNothing) {
  const auto house = [](const std::string& height, const std::string& id) {
    return building("<bldg:measuredHeight>" + height + "</bldg:measuredHeight><bldg:lod0RoofEdge><gml:MultiSurface>" +
                        member(polygon("edge_of_" + id, "10")) + "</gml:MultiSurface></bldg:lod0RoofEdge>",
                    id);
  };
  IngestSettings settings;
  settings.lod.exactly = 0;
  const Reading r = read_text("a.gml", model(house("inf", "endless") + house("1e300", "far") + house("4", "good")), settings);
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].id, "good");
  EXPECT_EQ(r.codes(), (std::set<int>{102, 111}));
}

TEST(CityGml, CirclesOfReferencesEnd) {
  const std::string loop = R"(<gml:CompositeSurface gml:id="loop">)" + reference("loop") + reference("loop") +
                           member(polygon("a", "1")) + "</gml:CompositeSurface>";
  EXPECT_EQ(read_text("a.gml", model(building(multi_surface("2", member(loop))))).city().facets().size(), 1u);
}

TEST(CityGml, OneByteEncodingsAreUnderstood) {
  std::string text = model(building(solid("2", member(polygon("a", "1"))), "Caf\xE9 \x80"));
  text.replace(text.find("?>"), 0, R"( encoding="windows-1252")");
  EXPECT_EQ(read_text("a.gml", text).city().buildings()[0].id, "Café €");
}

}  // namespace
}  // namespace farlod::ingest::test
