// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/gml_surfaces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace farlod::ingest {
namespace {

constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();

template <std::size_t n>
bool is_gml_name(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 4> polygon_names{"Polygon", "PolygonPatch", "Triangle", "Rectangle"};
constexpr std::array<std::string_view, 14> aggregate_names{
    "MultiSurface", "CompositeSurface",  "Surface",       "PolyhedralSurface", "TriangulatedSurface",
    "Tin",          "OrientableSurface", "Solid",         "CompositeSolid",    "MultiSolid",
    "Shell",        "TexturedSurface",   "MultiGeometry", "MultiPolygon"};
constexpr std::array<std::string_view, 17> property_names{
    "surfaceMember", "surfaceMembers", "exterior",        "interior",        "solidMember",    "solidMembers",
    "baseSurface",   "patches",        "trianglePatches", "polygonPatches",  "geometryMember", "geometryMembers",
    "polygonMember", "shellMember",    "outerBoundaryIs", "innerBoundaryIs", "surfaceProperty"};
constexpr std::array<std::string_view, 4> ring_element_names{"pointProperty", "pointRep", "Point", "coord"};
constexpr std::array<std::string_view, 3> coordinate_names{"posList", "pos", "coordinates"};

}  // namespace

void GmlSurfaceReader::begin_use(std::uint32_t use) {
  use_ = use;
  dimension_ = 3;
}

GmlSurfaceReader::Answer GmlSurfaceReader::start(const XmlElement& element) {
  note_dimension(element.srs_dimension);
  if (in_polygon_) return start_in_polygon(element);
  if (is_gml_name(element.name, polygon_names)) {
    start_polygon(element);
    return Answer::entered;
  }
  if (is_gml_name(element.name, aggregate_names)) {
    start_aggregate(element);
    return Answer::entered;
  }
  return start_property(element);
}

void GmlSurfaceReader::start_polygon(const XmlElement& element) {
  const std::size_t member = surfaces_.members.size();
  open_.push_back({std::string(element.id), {member, member, is_reversed_}, false});
  surfaces_.members.push_back({surfaces_.polygons.size(), {}, is_reversed_, use_});
  surfaces_.polygons.push_back({std::string(element.id), {}, false, false});
  in_polygon_ = true;
}

void GmlSurfaceReader::start_aggregate(const XmlElement& element) {
  const std::size_t member = surfaces_.members.size();
  const bool reverses = element.orientation == "-";
  open_.push_back({std::string(element.id), {member, member, is_reversed_}, reverses});
  if (reverses) is_reversed_ = !is_reversed_;
}

GmlSurfaceReader::Answer GmlSurfaceReader::start_property(const XmlElement& element) {
  if (is_gml_name(element.name, property_names)) {
    if (!element.href.empty()) add_reference(element.href);
    return Answer::entered;
  }
  // Names of objects begin with a capital letter; other elements are names, descriptions and the like
  const bool is_object = !element.name.empty() && element.name.front() >= 'A' && element.name.front() <= 'Z';
  return is_object ? Answer::unsupported : Answer::skip;
}

GmlSurfaceReader::Answer GmlSurfaceReader::start_in_polygon(const XmlElement& element) {
  Rings& rings = surfaces_.polygons.back().rings;
  if (element.name == "exterior" || element.name == "interior" || element.name == "outerBoundaryIs" ||
      element.name == "innerBoundaryIs") {
    rings.emplace_back();
  } else if (element.name == "LinearRing") {
    if (rings.empty()) rings.emplace_back();
    in_ring_ = true;
  } else if (element.name == "Ring") {
    surfaces_.polygons.back().has_curves = true;
    return Answer::skip;
  } else if (in_ring_ && is_gml_name(element.name, coordinate_names)) {
    in_coordinates_ = true;
    numbers_.clear();
  } else if (!in_ring_ || !is_gml_name(element.name, ring_element_names)) {
    return Answer::skip;
  }
  return Answer::entered;
}

void GmlSurfaceReader::end(std::string_view name) {
  if (in_coordinates_) {
    in_coordinates_ = false;
    take_coordinates(name);
  } else if (name == "LinearRing") {
    in_ring_ = false;
  } else if (is_gml_name(name, polygon_names)) {
    in_polygon_ = false;
    end_open();
  } else if (is_gml_name(name, aggregate_names)) {
    end_open();
  }
}

void GmlSurfaceReader::end_open() {
  Open& open = open_.back();
  open.range.end = surfaces_.members.size();
  if (open.reverses) is_reversed_ = !is_reversed_;
  // References lead to the first of two equal ids. The polygons of both are read
  if (!open.id.empty()) surfaces_.ranges.try_emplace(std::move(open.id), open.range);
  open_.pop_back();
}

void GmlSurfaceReader::text(std::string_view piece) {
  if (in_coordinates_) scanner_.take(piece, [this](double number) { take_number(number); });
}

void GmlSurfaceReader::take_number(double number) {
  // A number beyond the limit marks the list as too long
  if (numbers_.size() <= 3 * most_points_of_ring) numbers_.push_back(number);
}

void GmlSurfaceReader::add_reference(std::string_view href) {
  surfaces_.members.push_back({std::nullopt, std::string(href), is_reversed_, use_});
}

void GmlSurfaceReader::take_coordinates(std::string_view name) {
  scanner_.end([this](double number) { take_number(number); });
  GmlPolygon& polygon = surfaces_.polygons.back();
  Ring& ring = polygon.rings.back();
  const std::size_t count = numbers_.size();
  // The dimension of a single position is the number of its coordinates
  const std::size_t dimension = name == "pos" && count >= 2 ? count : dimension_;
  const std::size_t points = (count + dimension - 1) / dimension;
  if (polygon.is_too_long || ring.size() + points > most_points_of_ring) {
    polygon.is_too_long = true;
    ring = {};
    return;
  }
  if (ring.empty()) ring.reserve(points);
  for (std::size_t i = 0; i < count; i += dimension) {
    const auto number = [&](std::size_t k) { return i + k < count ? numbers_[i + k] : unreadable; };
    ring.push_back({number(0), number(1), dimension == 2 ? unreadable : number(2)});
  }
}

void GmlSurfaceReader::note_dimension(std::string_view srs_dimension) {
  if (srs_dimension == "2") dimension_ = 2;
  if (srs_dimension == "3") dimension_ = 3;
}

}  // namespace farlod::ingest
