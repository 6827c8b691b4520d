// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "citygml_text.hpp"
#include "package/sources_layout.hpp"
#include "reading.hpp"

// What city files call the surfaces of their buildings.

namespace farlod::ingest::test::surface_ids {
namespace {

constexpr const char *roof_1 = "1000 2000 8 1010 2000 8 1010 2010 8 1000 2010 8 1000 2000 8",
                     *roof_2 = "1010 2000 8 1020 2000 8 1020 2010 8 1010 2010 8 1010 2000 8",
                     *wall = "1000 2000 0 1000 2010 0 1000 2010 8 1000 2000 8 1000 2000 0";

std::string id_attribute(const std::string& id) { return id.empty() ? "" : " gml:id=\"" + id + "\""; }

std::string polygon(const std::string& corners, const std::string& id) {
  return "<gml:surfaceMember><gml:Polygon" + id_attribute(id) + "><gml:exterior><gml:LinearRing><gml:posList>" + corners +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}
std::string surface(const std::string& name, const std::string& id, const std::string& polygons) {
  return "<bldg:boundedBy><bldg:" + name + id_attribute(id) + ">" + within("bldg:lod2MultiSurface gml:MultiSurface", polygons) +
         "</bldg:" + name + "></bldg:boundedBy>";
}
std::string file_with(const std::string& content) {
  return "<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
         "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\">" +
         building(content) + "</CityModel>";
}

/// "0-2 roof; 2-3 wall" of the first building.
std::string ids_of(const Reading& reading) {
  const auto origin = package::origin_from(reading.city().origin_of(reading.city().buildings().front()));
  if (!origin) return "none";
  std::string text;
  for (const SurfaceIds& ids : origin->ids)
    text += std::to_string(ids.begin) + "-" + std::to_string(ids.end) + " " + (ids.behind_building_id ? "@" : "") + ids.id + "; ";
  return text;
}
std::string ids_of_gml(const std::string& content) { return ids_of(read_text("a.gml", file_with(content))); }

TEST(SurfaceIds, ASemanticSurfaceNamesItsPolygons) {
  EXPECT_EQ(ids_of_gml(surface("RoofSurface", "r", polygon(roof_1, "p1") + polygon(roof_2, "p2")) +
                       surface("WallSurface", "w", polygon(wall, "p3"))),
            "0-2 r; 2-3 w; ");
}

TEST(SurfaceIds, APolygonIsCalledByItsOwnWhereThatHasNone) {
  EXPECT_EQ(ids_of_gml(surface("RoofSurface", "", polygon(roof_1, "p1") + polygon(roof_2, "")) +
                       surface("WallSurface", "w", polygon(wall, ""))),
            "0-1 p1; 2-3 w; ");
}

TEST(SurfaceIds, OfTwoEqualPolygonsTheFirstNamesTheSurface) {
  EXPECT_EQ(ids_of_gml(surface("RoofSurface", "r", polygon(roof_1, "")) + surface("WallSurface", "w", polygon(roof_1, ""))),
            "0-1 r; ");
}

TEST(SurfaceIds, OfTooManyBytesAreNotKept) {
  const std::string longest(package::most_id_bytes, 'x');
  EXPECT_EQ(ids_of_gml(surface("RoofSurface", longest, polygon(roof_1, ""))), "0-1 " + longest + "; ");
  EXPECT_EQ(ids_of_gml(surface("RoofSurface", longest + "x", polygon(roof_1, ""))), "");
}

std::string json_with(const std::string& roof, const std::string& wall_and_on) {
  return R"({"type":"CityJSON","version":"2.0","CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)"
         R"("boundaries":[[[0,1,4,3]],[[1,2,5,4]],[[0,3,7,6]]],"semantics":{"surfaces":[{"type":"RoofSurface")" +
         roof + R"(},{"type":"WallSurface")" + wall_and_on +
         R"("vertices":[[0,0,8],[10,0,8],[20,0,8],[0,10,8],[10,10,8],[20,10,8],[0,0,0],[0,10,0]],)"
         R"("transform":{"scale":[1,1,1],"translate":[1000,2000,0]}})";
}

TEST(SurfaceIds, OfCityJsonAreThoseOfTheFileOrObjectAndRow) {
  const std::string values = R"(}],"values":[0,0,1]}}]}},)";
  EXPECT_EQ(ids_of(read_text("a.city.json", json_with("", values))), "0-2 @#0; 2-3 @#1; ");
  EXPECT_EQ(ids_of(read_text("a.city.json", json_with(R"(,"id":"r")", values))), "0-2 r; 2-3 @#1; ");
  // No semantics: no name
  EXPECT_EQ(ids_of(read_text("a.city.json", json_with("", R"(}],"values":[null,0,null]}}]}},)"))), "1-2 @#0; ");
}

}  // namespace
}  // namespace farlod::ingest::test::surface_ids
