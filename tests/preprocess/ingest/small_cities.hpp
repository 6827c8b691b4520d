// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace farlod::ingest::test {

/// The least that each format calls a city: a building of one triangle, called after the argument.
inline std::string cityjson_of(const std::string& id) {
  return R"({"type":"CityJSON","version":"2.0","CityObjects":{")" + id +
         R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}},)"
         R"("vertices":[[0,0,0],[1,0,0],[0,0,1]]})";
}

inline std::string citygml_of(const std::string& id) {
  return R"(<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0")"
         R"( xmlns:gml="http://www.opengis.net/gml"><cityObjectMember><bldg:Building gml:id=")" +
         id +
         R"("><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>)"
         "0 0 0 1 0 0 0 0 1 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>"
         "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building></cityObjectMember></CityModel>";
}

inline std::string obj_of(const std::string& id) { return "g " + id + "\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"; }

inline std::string geojson_of(const std::string& id) {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":")" + id +
         R"(","height":5},"geometry":{"type":"Polygon","coordinates":[[[9,48],[9.0001,48],[9,48.0001],[9,48]]]}}]})";
}

/// A feature of GeoJSON.
inline std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type + R"(","coordinates":)" +
         coordinates + "}}";
}
/// A file of features, with further members that end with a comma.
inline std::string collection(const std::vector<std::string>& features, const std::string& more = "") {
  std::string text = R"({"type":"FeatureCollection",)" + more + R"("features":[)";
  for (const std::string& f : features) text += (&f == &features.front() ? "" : ",") + f;
  return text + "]}";
}

/// A table of footprints, which has GML in common with CityGML.
inline std::string features_in_gml_of(const std::string& id) {
  return R"(<ogr:FeatureCollection xmlns:ogr="http://ogr.maptools.org/" xmlns:gml="http://www.opengis.net/gml"><gml:featureMember>)"
         R"(<ogr:house><ogr:height>5.5</ogr:height><ogr:id>)" +
         id +
         "</ogr:id><ogr:outline><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0 9,0 0,9 "
         "0,0</gml:coordinates>"
         "</gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></ogr:outline></ogr:house></gml:featureMember></"
         "ogr:FeatureCollection>";
}

inline const std::string elevations =
    "ncols 2\nnrows 2\nxllcorner 500000\nyllcorner 5400000\ncellsize 10\nNODATA_value -9999\n1 2\n3 4\n";

}  // namespace farlod::ingest::test
