// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
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

const std::string plain_house = building(surface("bldg:lod1MultiSurface", "a", "1"));

std::string refusal(const std::string& text) {
  try {
    (void)read_citygml_text(text);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

std::string with_doctype(const std::string& doctype) {
  std::string text = model(plain_house);
  return text.insert(text.find("?>") + 2, doctype);
}

TEST(CityGmlHostile, DeclarationsInADoctypeAreRefused) {
  const std::vector<std::string> doctypes{
      R"(<!DOCTYPE CityModel [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>)",      // doubles with each entity
      R"(<!DOCTYPE CityModel [<!ENTITY file SYSTEM "file:///etc/passwd">]>)",  // leads to another file
      R"(<!DOCTYPE CityModel [<!ENTITY % more SYSTEM "http://a/b.dtd">]>)",
      R"(<!DOCTYPE CityModel [<!ATTLIST CityModel href CDATA "long">]>)"};
  for (const std::string& doctype : doctypes) {
    const std::string said = refusal(with_doctype(doctype));
    EXPECT_NE(said.find("DOCTYPE"), std::string::npos) << doctype;
    EXPECT_NE(said.find("line 1"), std::string::npos) << said;
  }
}

TEST(CityGmlHostile, ADoctypeThatDeclaresNothingIsHarmless) {
  EXPECT_EQ(refusal(with_doctype(R"(<!DOCTYPE CityModel SYSTEM "http://nowhere/citygml.dtd">)")), "");
}

TEST(CityGmlHostile, EntitiesOfAnotherFileAreRefused) {
  std::string text = with_doctype(R"(<!DOCTYPE CityModel SYSTEM "http://nowhere/citygml.dtd">)");
  text.insert(text.find("<cityObjectMember>"), "<gml:name>&secret;</gml:name>");
  EXPECT_NE(refusal(text).find("&secret;"), std::string::npos);
}

TEST(CityGmlHostile, DeepElementsAreRefused) {
  const auto nested = [](std::size_t depth) {
    std::string begins, ends;
    for (std::size_t k = 0; k < depth; ++k) {
      begins += "<gml:a>";
      ends += "</gml:a>";
    }
    return model(begins + ends + plain_house);
  };
  EXPECT_EQ(refusal(nested(255)), "") << "the model itself is the first of 256";
  EXPECT_NE(refusal(nested(256)).find("nested deeper than 256"), std::string::npos);
}

TEST(CityGmlHostile, EndlessTagsAreRefused) {
  constexpr std::size_t four_mib = std::size_t{1} << 22;
  const auto said_of = [](std::size_t bytes) {
    return refusal(model("<gml:name gml:id=\"" + std::string(bytes, 'x') + "\"/>" + plain_house));
  };
  EXPECT_EQ(said_of(four_mib / 2), "");
  EXPECT_NE(said_of(four_mib + four_mib / 2).find("4194304 bytes"), std::string::npos);
}

TEST(CityGmlHostile, AnEndlessRingIsLeftOutOfItsBuilding) {
  std::string list = "0 0 0";
  for (std::size_t k = 0; k < most_points_of_ring; ++k) list += " 1 1 1";
  const auto of_list = [](const std::string& positions) {
    return within("bldg:lod1MultiSurface gml:MultiSurface gml:surfaceMember gml:Polygon gml:exterior gml:LinearRing", positions);
  };
  for (const std::string& positions :
       {within("gml:posList", list), within("gml:posList", list.substr(5)) + within("gml:pos", "0 0 0")}) {
    const Reading r =
        read_citygml_text(model(building(of_list(positions) + surface("bldg:lod1MultiSurface", "a", "1"), "endless")));
    EXPECT_EQ(r.city().facets().size(), 1u);
    ASSERT_EQ(r.codes(), std::set<int>{112});
    EXPECT_EQ(r.report.problems()[0].place, "endless");
    EXPECT_NE(r.report.problems()[0].detail.find("1048576 points"), std::string::npos);
  }
}

TEST(CityGmlHostile, ManyReferencesToManyPolygonsTakeNoTime) {
  // 20,000 x 20,000: at a nanosecond each it would take minutes under a sanitizer
  constexpr int many = 20'000;
  std::string polygons, references;
  for (int k = 0; k < many; ++k) {
    polygons += member(polygon("p" + std::to_string(k), std::to_string(k)));
    references += reference("all");
  }
  const std::string all = R"(<gml:CompositeSurface gml:id="all">)" + polygons + "</gml:CompositeSurface>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", references + member(all)))));
  EXPECT_EQ(r.city().facets().size(), std::size_t{many});
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlHostile, ManyReferencesToUnusablePolygonsTakeNoTime) {
  constexpr int many = 20'000;
  std::string polygons, references;
  for (int k = 0; k < many; ++k) {
    polygons += member("<gml:Polygon/>");
    references += reference("all");
  }
  const std::string all = R"(<gml:CompositeSurface gml:id="all">)" + polygons + "</gml:CompositeSurface>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", references + member(all))) + plain_house));
  EXPECT_EQ(r.codes(), (std::set<int>{106, 111}));
}

TEST(CityGmlHostile, ALongChainOfReferencesIsFollowedToItsEnd) {
  std::string links = member(polygon("p0", "3"));
  for (int k = 1; k < 5'000; ++k)
    links += R"(<gml:surfaceMember><gml:CompositeSurface gml:id="p)" + std::to_string(k) + R"(">)" +
             reference("p" + std::to_string(k - 1)) + "</gml:CompositeSurface></gml:surfaceMember>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", reference("p4999") + links))));
  EXPECT_EQ(heights(r.city()), std::vector<double>{3});
  EXPECT_TRUE(r.codes().empty());
}

/// A house whose wall lies behind so many links, each in a thing of its own, and each found by one more reading of the
/// file.
Reading house_behind(int links) {
  const auto thing = [](int k, const std::string& content) {
    return R"(<cityObjectMember><uro:Thing><gml:MultiSurface gml:id="p)" + std::to_string(k) + R"(">)" + content +
           "</gml:MultiSurface></uro:Thing></cityObjectMember>";
  };
  std::string chain = thing(0, member(polygon("wall", "3")));
  for (int k = 1; k < links; ++k) chain += thing(k, reference("p" + std::to_string(k - 1)));
  return read_citygml_text(model(chain + building(multi_surface("2", reference("p" + std::to_string(links - 1))))));
}

TEST(CityGmlHostile, AChainOfReferencesThroughTheFileEnds) {
  for (const int links : {1, 2, 6}) EXPECT_EQ(heights(house_behind(links).city()), std::vector<double>{3}) << links;
  EXPECT_EQ(house_behind(7).codes(), (std::set<int>{111}));
}

TEST(CityGmlHostile, AReferenceIsGoneThroughOnce) {
  GmlSurfaces surfaces;
  surfaces.polygons.resize(100);
  for (std::size_t k = 0; k < 100; ++k) surfaces.members.push_back({k, {}, false, 0});
  surfaces.ranges["all"] = {0, 100, false};
  const GmlMember all{std::nullopt, "#all", false, 0};
  ReferenceBudget budget({});
  const GmlSurfaces none;
  ReferenceWalk asking(surfaces, none, budget), visiting(surfaces, none, budget);
  std::size_t asked = 0, visited = 0;
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(asking.any(all, [&](const GmlPolygon&) { return ++asked == 0; }));
    visiting.each(all, [&](const ResolvedPolygon&) { ++visited; });
  }
  for (const GmlMember& member : surfaces.members) visiting.each(member, [&](const ResolvedPolygon&) { ++visited; });
  EXPECT_EQ(asked, 100u);
  EXPECT_EQ(visited, 100u);
  ReferenceWalk finding(surfaces, none, budget);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(finding.any(all, [](const GmlPolygon&) { return true; })) << "asked again: " << k;
}

TEST(CityGmlHostile, TheBudgetOfReferencesEnds) {
  ReferenceBudget budget({});
  EXPECT_TRUE(budget.take(budget.most_points() - 1));
  EXPECT_EQ(budget.refusals(), 0u);
  EXPECT_FALSE(budget.take(2));
  EXPECT_FALSE(budget.take(1)) << "what was too much once ends it: small things after large ones would look whole";
  EXPECT_EQ(budget.refusals(), 2u);
}

TEST(CityGmlHostile, OrdinaryCitiesMayUseAllTheirReferences) {
  GmlSurfaces foreign;
  foreign.polygons.resize(1'000'000);
  ReferenceBudget budget(foreign);
  EXPECT_EQ(budget.most_points(), 5'000'000u + 16u * 1'000'000u) << "a polygon without points counts as one";
}

TEST(CityGmlHostile, BuildingsThatAllShareALargeThingSayWhatIsMissing) {
  std::string polygons, houses;
  for (int k = 0; k < 6'000; ++k) polygons += member(polygon("p" + std::to_string(k), std::to_string(k)));
  // A polygon of four points costs five: 5,000,000 + 16 * 30,000 are to be had, 200 * 30,000 are wanted
  for (int k = 0; k < 200; ++k)
    houses += building(R"(<bldg:lod2MultiSurface xlink:href="#all"/>)" + surface("bldg:lod2MultiSurface", "own", "1"),
                       "house " + std::to_string(k));
  const std::string large = building(
      R"(<bldg:lod2MultiSurface><gml:MultiSurface gml:id="all">)" + polygons + "</gml:MultiSurface></bldg:lod2MultiSurface>",
      "large");
  const Reading r = read_citygml_text(model(large + houses));
  EXPECT_EQ(r.city().buildings().size(), 201u);
  EXPECT_EQ(r.codes(), std::set<int>{112});
  EXPECT_NE(r.report.problems()[0].detail.find("5480000 points"), std::string::npos);
}

TEST(CityGmlHostile, KindsThatAreNotReadAreFewInTheReport) {
  std::string things;
  for (int k = 0; k < 1'000; ++k) things += "<gml:Thing" + std::to_string(k) + "/>";
  things += "<gml:Thing0/>";
  const Reading r = read_citygml_text(model(building(
      surface("bldg:lod1MultiSurface", "a", "1") + within("bldg:lod1MultiSurface gml:MultiSurface gml:surfaceMember", things))));
  EXPECT_EQ(r.report.problems().size(), 17u);
  EXPECT_NE(std::find_if(r.report.problems().begin(), r.report.problems().end(),
                         [](const Problem& p) { return p.detail == "a gml:Thing0 is not read (2 times)"; }),
            r.report.problems().end());
}

std::vector<double> numbers_of(const std::vector<std::string>& pieces) {
  std::vector<double> numbers;
  NumberScanner scanner;
  const auto sink = [&](double number) { numbers.push_back(number); };
  for (const std::string& piece : pieces) scanner.take(piece, sink);
  scanner.end(sink);
  return numbers;
}

TEST(CityGmlHostile, NumbersMayBeBrokenAnywhere) {
  const std::string text = " 1.5 -2e1,+3\n4\t";
  const std::vector<double> expected{1.5, -20, 3, 4};
  for (std::size_t k = 0; k <= text.size(); ++k) EXPECT_EQ(numbers_of({text.substr(0, k), text.substr(k)}), expected) << k;
  std::vector<std::string> letters;
  for (const char c : text) letters.emplace_back(1, c);
  EXPECT_EQ(numbers_of(letters), expected);
}

TEST(CityGmlHostile, WordsThatAreNoNumbersAreNaN) {
  for (const std::string word : {"x", "1x", "+", "-", "1..2", "1e999", "--1", "0x10"}) {
    const std::vector<double> numbers = numbers_of({"7 " + word + " 8"});
    ASSERT_EQ(numbers.size(), 3u) << word;
    EXPECT_TRUE(std::isnan(numbers[1])) << word;
    EXPECT_EQ(numbers[2], 8.0) << word;
  }
  EXPECT_TRUE(std::isnan(numbers_of({std::string(2'000, '1'), " "}).at(0))) << "longer than any number";
}

}  // namespace
}  // namespace farlod::ingest::test
