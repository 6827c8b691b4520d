// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "ingest/citygml/citygml_reader.hpp"
#include "reading.hpp"

/// Small CityGML files, put together from their parts.
namespace farlod::ingest::test {

inline std::string model(const std::string& members) {
  return R"(<?xml version="1.0"?><CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml")"
         R"( xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:xlink="http://www.w3.org/1999/xlink")"
         R"( xmlns:uro="urn:some:ade" xmlns:app="http://www.opengis.net/citygml/appearance/2.0")"
         R"( xmlns:brid="http://www.opengis.net/citygml/bridge/2.0" xmlns:tun="http://www.opengis.net/citygml/tunnel/2.0")"
         R"( xmlns:dem="http://www.opengis.net/citygml/relief/2.0" xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0")"
         R"( xmlns:core="http://www.opengis.net/citygml/2.0">)"
         R"(<gml:boundedBy><gml:Envelope srsName="EPSG:25832"><gml:lowerCorner>0 0 0</gml:lowerCorner></gml:Envelope></gml:boundedBy>)" +
         members + "</CityModel>";
}
inline std::string building(const std::string& content, const std::string& id = "b") {
  return R"(<cityObjectMember><bldg:Building gml:id=")" + id + R"(">)" + content + "</bldg:Building></cityObjectMember>";
}
inline std::string ring(const std::string& z, const std::string& x = "0") {
  return "<gml:LinearRing><gml:posList>" + x + " 0 " + z + " 9 0 " + z + " 9 9 " + z + " " + x + " 0 " + z +
         "</gml:posList></gml:LinearRing>";
}
/// A triangle at height z.
inline std::string polygon(const std::string& id, const std::string& z) {
  return R"(<gml:Polygon gml:id=")" + id + R"("><gml:exterior>)" + ring(z) + "</gml:exterior></gml:Polygon>";
}
inline std::string member(const std::string& content) { return "<gml:surfaceMember>" + content + "</gml:surfaceMember>"; }
inline std::string reference(const std::string& id) { return R"(<gml:surfaceMember xlink:href="#)" + id + R"("/>)"; }
inline std::string multi_surface(const std::string& lod, const std::string& members) {
  return "<bldg:lod" + lod + "MultiSurface><gml:MultiSurface>" + members + "</gml:MultiSurface></bldg:lod" + lod +
         "MultiSurface>";
}
inline std::string solid(const std::string& lod, const std::string& members) {
  return "<bldg:lod" + lod + "Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod" + lod + "Solid>";
}
inline std::string bounded_by(const std::string& kind, const std::string& content) {
  return "<bldg:boundedBy><bldg:" + kind + ">" + content + "</bldg:" + kind + "></bldg:boundedBy>";
}
inline std::vector<double> heights(const CityModel& city) {
  std::vector<double> z;
  for (const Facet& f : city.facets()) z.push_back(city.ring(f, 0)[0].z);
  return z;
}

/// A file of CityGML 3.0.
inline std::string model_3(const std::string& members) {
  return R"(<CityModel xmlns="http://www.opengis.net/citygml/3.0" xmlns:gml="http://www.opengis.net/gml/3.2")"
         R"( xmlns:core="http://www.opengis.net/citygml/3.0" xmlns:bldg="http://www.opengis.net/citygml/building/3.0")"
         R"( xmlns:con="http://www.opengis.net/citygml/construction/3.0" xmlns:brid="http://www.opengis.net/citygml/bridge/3.0")"
         R"( xmlns:tun="http://www.opengis.net/citygml/tunnel/3.0" xmlns:gen="http://www.opengis.net/citygml/generics/3.0")"
         R"( xmlns:dem="http://www.opengis.net/citygml/relief/3.0" xmlns:xlink="http://www.w3.org/1999/xlink">)" +
         members + "</CityModel>";
}

/// `content` in elements, the outermost first: "a b" gives <a><b>content</b></a>.
inline std::string within(const std::string& elements, const std::string& content) {
  const std::size_t space = elements.find(' ');
  const std::string name = elements.substr(0, space);
  const std::string inner = space == elements.npos ? content : within(elements.substr(space + 1), content);
  return "<" + name + ">" + inner + "</" + name + ">";
}

/// One triangle at height z as the surface of a level of detail.
inline std::string surface(const std::string& property, const std::string& id, const std::string& z) {
  return within(property + " gml:MultiSurface gml:surfaceMember", polygon(id, z));
}

/// By the reader of CityGML alone, which lets files of terrain pass.
inline Reading read_citygml_text(const std::string& text, LodChoice lod = {}) {
  Reading reading;
  reading.source = read_citygml(write_file("a.gml", text), lod, reading.report);
  return reading;
}

}  // namespace farlod::ingest::test
