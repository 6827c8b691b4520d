// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/gml_surfaces.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace farlod::ingest {
namespace {

constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();

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
  if (is_one_of(element.name, polygon_names)) {
    start_polygon(element);
    return Answer::entered;
  }
  if (is_one_of(element.name, aggregate_names)) {
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
  if (is_one_of(element.name, property_names)) {
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
  } else if (in_ring_ && is_one_of(element.name, coordinate_names)) {
    in_coordinates_ = true;
    numbers_.clear();
  } else if (!in_ring_ || !is_one_of(element.name, ring_element_names)) {
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
  } else if (is_one_of(name, polygon_names)) {
    in_polygon_ = false;
    end_open();
  } else if (is_one_of(name, aggregate_names)) {
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

namespace {

constexpr std::size_t points_of_prototypes = 5'000'000;
/// Two or three buildings share a wall, and each visits it three times.
constexpr std::size_t visits_of_each_point = 16;

}  // namespace

ReferenceBudget::ReferenceBudget(const GmlSurfaces& foreign) : most_points_(points_of_prototypes) {
  for (const GmlPolygon& polygon : foreign.polygons) most_points_ += visits_of_each_point * polygon.point_count();
  left_ = most_points_;
}

bool ReferenceBudget::take(std::size_t points) {
  if (points > left_) left_ = 0;
  if (left_ == 0) {
    ++refusals_;
    return false;
  }
  left_ -= points;
  return true;
}

bool ReferenceBudget::append(const ReferenceBudget& other) {
  const std::size_t given = other.most_points_ - other.left_;
  if (other.refusals_ > 0 || given > left_) return false;
  left_ -= given;
  return true;
}

void ReferenceWalk::each(const GmlMember& member, const std::function<void(const ResolvedPolygon&)>& visit) {
  walk(member, [&](const ResolvedPolygon& p) {
    if (reached_.insert(p.polygon).second) visit(p);
    return false;
  });
}

bool ReferenceWalk::any(const GmlMember& member, const std::function<bool(const GmlPolygon&)>& is_it) {
  return walk(member, [&](const ResolvedPolygon& p) { return is_it(*p.polygon); });
}

bool ReferenceWalk::walk(const GmlMember& member, const IsEnough& is_enough) {
  levels_.clear();
  bool is_found = step(own_, member, false, is_enough);
  while (!is_found && !levels_.empty()) {
    Level& level = levels_.back();
    if (level.next == level.end)
      levels_.pop_back();
    else
      is_found = step(*level.home, level.home->members[level.next++], level.is_reversed, is_enough);
  }
  if (is_found)
    for (const Level& level : levels_) *level.ends_walks = true;
  return is_found;
}

bool ReferenceWalk::step(const GmlSurfaces& home, const GmlMember& member, bool is_reversed, const IsEnough& is_enough) {
  const bool turned = is_reversed != member.is_reversed;
  if (&home == &foreign_ && !budget_.take(member.polygon ? home.polygons[*member.polygon].point_count() : 1)) return false;
  if (!member.polygon) return enter(member.href, turned);
  return is_enough({&home.polygons[*member.polygon], turned, &home == &foreign_});
}

bool ReferenceWalk::enter(const std::string& href, bool is_reversed) {
  const std::string id = href.starts_with('#') ? href.substr(1) : std::string();
  for (const GmlSurfaces* there : {&own_, &foreign_})
    if (const auto found = there->ranges.find(id); !id.empty() && found != there->ranges.end()) {
      const auto [entry, is_new] = entered_.try_emplace(id, false);
      if (!is_new) return entry->second;
      const GmlRange& range = found->second;
      levels_.push_back({there, range.begin, range.end, is_reversed != range.was_reversed, &entry->second});
      return false;
    }
  dangling_.push_back(href);
  return false;
}

}  // namespace farlod::ingest
