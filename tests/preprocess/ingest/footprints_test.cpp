// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"

#include "farlod/error.hpp"
#include "ingest/footprints/height_text.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type + R"(","coordinates":)" +
         coordinates + "}}";
}

std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (const std::string& f : features) text += (&f == &features.front() ? "" : ",") + f;
  return text + "]}";
}

const std::string square = "[[[0,0],[4,0],[4,4],[0,4],[0,0]]]";
// The hole runs the same way round as the outer ring: files do not agree on this
const std::string court = "[[[0,0],[0,4],[4,4],[4,0],[0,0]],[[1,1],[1,3],[3,3],[3,1],[1,1]]]";

/// The volume under the outward normals (divergence theorem).
double volume(const CityModel& city) {
  double sum = 0.0;
  for (const Facet& f : city.facets())
    for (std::uint32_t k = 0; k < f.ring_count; ++k) {
      const auto ring = city.ring(f, k);
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += dot(ring[0], cross(ring[i], ring[i + 1]));
    }
  return sum / 6.0;
}

TEST(Footprints, SayHowManyHeightsWereNotMeasured) {
  IngestSettings settings;
  settings.footprints.default_height_m = 5.0;
  settings.footprints.floor_height_m = 2.5;
  const Reading r =
      read_text("a.geojson",
                collection({feature(R"("height":3)", "Polygon", square), feature(R"("levels":4)", "Polygon", square),
                            feature(R"("levels":2)", "Polygon", square), feature("", "Polygon", square)}),
                settings);
  ASSERT_EQ(r.source.notes.size(), 2u);
  EXPECT_TRUE(r.source.notes[0].ends_with("a.geojson: 2 heights are storeys of 2.5 m")) << r.source.notes[0];
  EXPECT_TRUE(r.source.notes[1].ends_with("a.geojson: 1 heights are the default height")) << r.source.notes[1];
  EXPECT_TRUE(read_text("a.geojson", collection({feature(R"("height":3)", "Polygon", square)})).source.notes.empty());
}

TEST(Footprints, BecomePrismsThatFaceOutwards) {
  const Reading r = read_text("a.geojson", collection({feature(R"("height":3)", "Polygon", square)}));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(surface_count(r.city()), 6u);
  EXPECT_EQ(volume(r.city()), 48.0);
  for (const Facet& f : r.city().facets()) {
    const Point3d n = double_area_vector(r.city(), f);
    EXPECT_EQ(kind_of_normal(normalized(n)), f.kind);
  }
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::on_ground);
  EXPECT_TRUE(r.source.crs.longitude_first);
  EXPECT_TRUE(r.source.crs.heights_in_metres);
  EXPECT_NE(r.source.crs.definition.find("WGS 84"), std::string::npos);
}

TEST(Footprints, HolesGetWallsTooWhicheverWayTheyRun) {
  const Reading r = read_text("a.geojson", collection({feature(R"("height":2)", "Polygon", court)}));
  EXPECT_EQ(surface_count(r.city()), 10u);
  EXPECT_EQ(volume(r.city()), (16.0 - 4.0) * 2.0);
}

TEST(Footprints, AFeatureOfSeveralPolygonsIsOneBuildingWithParts) {
  const Reading r = read_text(
      "a.geojson", collection({feature(R"("height":2)", "MultiPolygon", "[" + square + ",[[[9,0],[10,0],[10,1],[9,0]]]]")}));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().facets().front().part, 0);
  EXPECT_EQ(r.city().facets().back().part, 1);
  EXPECT_EQ(surface_count(r.city()), 11u);
}

TEST(Footprints, TheBaseComesFromItsOwnField) {
  IngestSettings settings;
  settings.footprints = {.height_field = "h", .base_field = "ground"};
  const Reading r = read_text("a.geojson", collection({feature(R"("h":"10 ft","ground":100)", "Polygon", square)}), settings);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::elevation);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 100.0 + 10.0 * 0.3048);
}

TEST(Footprints, ADefaultHeightServesThoseWithoutOne) {
  IngestSettings settings;
  settings.footprints.default_height_m = 7.0;
  const Reading r =
      read_text("a.geojson", collection({feature("", "Polygon", square), feature(R"("height":3)", "Polygon", square)}), settings);
  EXPECT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 7.0);
  EXPECT_TRUE(r.codes().empty());
}

TEST(Footprints, IdsComeFromTheTableOrAreNumbers) {
  const Reading r = read_text("a.geojson", collection({feature(R"("height":3,"@id":"way/7")", "Polygon", square),
                                                       feature(R"("height":3)", "Polygon", square)}));
  EXPECT_EQ(r.city().buildings()[0].id, "way/7");
  EXPECT_EQ(r.city().buildings()[1].id, "1");
}

TEST(Footprints, ElevationsOfVerticesAreIgnored) {
  const Reading r =
      read_text("a.geojson", collection({feature(R"("height":3)", "Polygon", "[[[0,0,50],[4,0,51],[4,4,52],[0,0,50]]]")}));
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 3.0);
}

TEST(Footprints, ATableWithoutHeightsNamesItsNumbers) {
  const std::filesystem::path file =
      write_file("a.geojson", collection({feature(R"("rooms":3,"area":"4.5","use":"school")", "Polygon", square)}));
  for (const FootprintSettings& footprints : {FootprintSettings{}, FootprintSettings{.height_field = "TAKASA"}}) {
    IngestSettings settings;
    settings.footprints = footprints;
    try {
      (void)read_file(file, settings);
      FAIL() << "an InputError was due";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("rooms, area"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--height-field"), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("use"), std::string::npos) << error.what();
    }
  }
}

TEST(Footprints, StoreysServeThoseWithoutAHeight) {
  IngestSettings settings;
  settings.footprints.floor_height_m = 3.25;
  const Reading r = read_text("a.geojson",
                              collection({feature(R"("height":"17.5 m","building:levels":"9")", "Polygon", square),
                                          feature(R"("height":null,"building:levels":"4")", "Polygon", square),
                                          feature(R"("height":null,"building:levels":null)", "Polygon", square)}),
                              settings);
  ASSERT_EQ(r.city().buildings().size(), 2u);
  EXPECT_EQ(r.city().points_of(r.city().buildings()[0])[0].z, 17.5);
  EXPECT_EQ(r.city().points_of(r.city().buildings()[1])[0].z, 13.0);
  EXPECT_EQ(r.codes(), std::set<int>{107});
  EXPECT_EQ(r.report.problems()[0].detail, "height is empty, building:levels is empty");
}

TEST(Footprints, FieldsThatAreAskedForMustBeThere) {
  const std::filesystem::path file = write_file("a.geojson", collection({feature(R"("height":3)", "Polygon", square)}));
  IngestSettings storeys, roof;
  storeys.footprints.storeys_field = roof.footprints.roof_field = "nowhere";
  for (const auto& [settings, option] : {std::pair(storeys, "--storeys-field"), std::pair(roof, "--roof-field")}) {
    try {
      (void)read_file(file, settings);
      FAIL() << "an InputError was due";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
    }
  }
}

TEST(Footprints, OfWhichOnlyTheRoofIsKnownReachDownToTheGround) {
  IngestSettings settings;
  settings.footprints.roof_field = "roof";
  const Reading r = read_text("a.geojson", collection({feature(R"("roof":"412,5")", "Polygon", court)}), settings);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::down_to_ground);
  EXPECT_EQ(r.city().ring(r.city().facets()[0], 0)[0].z, 412.5);
}

/// The sides of a cube with an edge of 2e-5°, which is about 2 m, at 100 m.
std::string cube_sides() {
  const auto at = [](int corner) {
    return "[" + std::string(corner & 1 ? "8.40002" : "8.4") + "," + (corner & 2 ? "49.00002" : "49.0") + "," +
           (corner & 4 ? "102" : "100") + "]";
  };
  std::string sides;
  for (const auto& side : std::vector<std::vector<int>>{
           {0, 2, 3, 1, 0}, {4, 5, 7, 6, 4}, {0, 1, 5, 4, 0}, {1, 3, 7, 5, 1}, {3, 2, 6, 7, 3}, {2, 0, 4, 6, 2}}) {
    std::string ring;
    for (const int corner : side) ring += (ring.empty() ? "" : ",") + at(corner);
    sides += (sides.empty() ? "[[" : ",[[") + ring + "]]";
  }
  return "[" + sides + "]";
}

TEST(Footprints, BodiesInSpaceStandAsTheyAre) {
  const Reading r = read_text("a.geojson", collection({feature(R"("name":"cube")", "MultiPolygon", cube_sides())}));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::elevation);
  EXPECT_EQ(r.city().facets().size(), 6u);
  EXPECT_FALSE(r.source.crs.heights_in_metres);
  for (const Point3d& p : r.city().points()) EXPECT_TRUE(p.z == 100 || p.z == 102);
}

TEST(Footprints, SurfacesOfFacesAreBodiesToo) {
  const std::string tetrahedron =
      "((0 0 5,0 8 5,8 0 5,0 0 5)),((0 0 5,8 0 5,0 0 9,0 0 5)),((8 0 5,0 8 5,0 0 9,8 0 5)),((0 8 5,0 0 5,0 0 9,0 8 5))";
  for (const char* type : {"TIN", "POLYHEDRALSURFACE", "MULTIPOLYGON"}) {
    const Reading r =
        read_text(std::string(type) + ".csv", "WKT,name\n\"" + std::string(type) + " Z (" + tetrahedron + ")\",x\n");
    EXPECT_EQ(r.city().facets().size(), 4u) << type;
    EXPECT_EQ(volume(r.city()), 8.0 * 8.0 * 4.0 / 6.0) << type;
  }
}

TEST(Footprints, DrapedOverTheTerrainAreNoBodies) {
  const std::string draped =
      "[[[[8.4,49,50],[8.4001,49,53],[8.4001,49.0001,55],[8.4,49,50]]],"
      "[[[8.41,49,50],[8.4101,49,51],[8.4101,49.0001,52],[8.41,49,50]]]]";
  const Reading r = read_text("a.geojson", collection({feature(R"("height":3)", "MultiPolygon", draped)}));
  EXPECT_EQ(r.city().buildings()[0].height_reference, HeightReference::on_ground);
  EXPECT_EQ(r.city().facets().size(), 10u);
  // A hut of 1 m on a cliff is steep, but still a footprint: one polygon makes no body
  const std::string hut = "[[[8.4,49,50],[8.40001,49,50],[8.40001,49.00001,57],[8.4,49,50]]]";
  const Reading cliff = read_text("b.geojson", collection({feature(R"("height":3)", "Polygon", hut)}));
  EXPECT_EQ(cliff.city().facets().size(), 5u);
}

TEST(Footprints, AreNotMixedWithBodies) {
  std::vector<std::string> features(100, feature(R"("height":3)", "Polygon", square));
  features.push_back(feature(R"("height":3,"id":"cube")", "MultiPolygon", cube_sides()));
  const Reading r = read_text("a.geojson", collection(features));
  EXPECT_EQ(r.city().buildings().size(), 100u);
  ASSERT_EQ(r.report.count(ProblemCode::unsupported_geometry), 1u);
}

TEST(Footprints, HeightsInAllNotations) {
  EXPECT_EQ(length_m_from("17.5"), 17.5);
  EXPECT_EQ(length_m_from(" 17,5 m "), 17.5);
  EXPECT_EQ(length_m_from("57 ft"), 57 * 0.3048);
  EXPECT_EQ(length_m_from("57'"), 57 * 0.3048);
  EXPECT_EQ(length_m_from("10'6\""), 10.5 * 0.3048);
  EXPECT_EQ(length_m_from("-3"), -3.0);
  for (const char* text : {"", "high", "10-12", "10 storeys", "1.2.3", "nan", "inf", "5 6", "10'x"})
    EXPECT_EQ(length_m_from(text), std::nullopt) << text;
}

}  // namespace
}  // namespace farlod::ingest::test
