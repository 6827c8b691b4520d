// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_surfaces.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

namespace farlod {
namespace {

constexpr std::size_t most_points_of_ring = std::size_t{1} << 20;
constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();

template <std::size_t n>
bool is_gml_name(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::ranges::find(names, name) != names.end();
}

constexpr std::array<std::string_view, 4> polygons{"Polygon", "PolygonPatch", "Triangle", "Rectangle"};
constexpr std::array<std::string_view, 14> objects{
    "MultiSurface", "CompositeSurface",  "Surface",       "PolyhedralSurface", "TriangulatedSurface",
    "Tin",          "OrientableSurface", "Solid",         "CompositeSolid",    "MultiSolid",
    "Shell",        "TexturedSurface",   "MultiGeometry", "MultiPolygon"};
constexpr std::array<std::string_view, 17> properties{
    "surfaceMember", "surfaceMembers", "exterior",        "interior",        "solidMember",    "solidMembers",
    "baseSurface",   "patches",        "trianglePatches", "polygonPatches",  "geometryMember", "geometryMembers",
    "polygonMember", "shellMember",    "outerBoundaryIs", "innerBoundaryIs", "surfaceProperty"};
constexpr std::array<std::string_view, 4> borders{"exterior", "interior", "outerBoundaryIs", "innerBoundaryIs"};
constexpr std::array<std::string_view, 4> around_positions{"pointProperty", "pointRep", "Point", "coord"};
constexpr std::array<std::string_view, 3> coordinate_lists{"posList", "pos", "coordinates"};

double number_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && stop == word.data() + word.size() ? value : unreadable;
}

}  // namespace

std::vector<double> numbers_in(std::string_view text) {
  constexpr std::string_view separators = " \n\t\r,";
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(separators); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    numbers.push_back(number_from(text.substr(at, end - at)));
    at = text.find_first_not_of(separators, end);
  }
  return numbers;
}

void CityGmlSurfaceReader::begin_use(std::size_t use) {
  use_ = use;
  dimension_ = 3;
}

void CityGmlSurfaceReader::add_reference(std::string_view href) {
  surfaces_.members.push_back({std::nullopt, std::string(href), use_});
}

bool CityGmlSurfaceReader::start(const XmlTag& tag) {
  if (tag.srs_dimension == "2") dimension_ = 2;
  if (tag.srs_dimension == "3") dimension_ = 3;
  if (in_polygon_) return start_in_polygon(tag);
  if (is_gml_name(tag.name, polygons)) {
    open_object(tag, Level::polygon);
    surfaces_.members.push_back({surfaces_.polygons.size(), {}, use_});
    surfaces_.polygons.emplace_back();
    in_polygon_ = true;
  } else if (is_gml_name(tag.name, objects)) {
    open_object(tag, Level::object);
  } else if (is_gml_name(tag.name, properties)) {
    if (!tag.href.empty()) add_reference(tag.href);
    open_.push_back({});
  } else {
    return false;
  }
  return true;
}

void CityGmlSurfaceReader::open_object(const XmlTag& tag, Level level) {
  open_.push_back({level, std::string(tag.id), surfaces_.members.size()});
}

bool CityGmlSurfaceReader::start_in_polygon(const XmlTag& tag) {
  CityGmlPolygon& polygon = surfaces_.polygons.back();
  Level level = Level::property;
  if (is_gml_name(tag.name, borders)) {
    polygon.rings.emplace_back();
  } else if (tag.name == "LinearRing") {
    if (polygon.rings.empty()) polygon.rings.emplace_back();
    in_ring_ = true;
    level = Level::ring;
  } else if (tag.name == "Ring") {
    polygon.has_number = false;
    return false;
  } else if (in_ring_ && is_gml_name(tag.name, coordinate_lists)) {
    coordinates_.clear();
    is_one_position_ = tag.name == "pos";
    level = Level::coordinates;
  } else if (!in_ring_ || !is_gml_name(tag.name, around_positions)) {
    return false;
  }
  open_.push_back({level, {}, 0});
  return true;
}

void CityGmlSurfaceReader::end() {
  Open open = std::move(open_.back());
  open_.pop_back();
  if (open.level == Level::coordinates) take_coordinates();
  if (open.level == Level::ring) in_ring_ = false;
  if (open.level == Level::polygon) in_polygon_ = false;
  // Of two equal ids, references lead to the first
  if (!open.id.empty()) surfaces_.ranges.try_emplace(std::move(open.id), CityGmlRange{open.begin, surfaces_.members.size()});
}

void CityGmlSurfaceReader::text(std::string_view piece) {
  if (!open_.empty() && open_.back().level == Level::coordinates) coordinates_ += piece;
}

void CityGmlSurfaceReader::take_coordinates() {
  const std::vector<double> list = numbers_in(coordinates_);
  CityGmlPolygon& polygon = surfaces_.polygons.back();
  FileRing& ring = polygon.rings.back();
  // The dimension of a single position is the number of its coordinates
  const std::size_t dimension = is_one_position_ && list.size() >= 2 ? list.size() : dimension_;
  const auto number = [&](std::size_t k) { return k < list.size() ? list[k] : unreadable; };
  for (std::size_t i = 0; i < list.size(); i += dimension)
    ring.push_back({number(i), number(i + 1), dimension == 2 ? unreadable : number(i + 2)});
  if (ring.size() > most_points_of_ring) polygon.has_number = false;
}

void CityGmlWalk::each(const CityGmlMember& member, const std::function<void(const ReachedPolygon&)>& visit) {
  (void)walk(member, [&](const ReachedPolygon& p) {
    if (reached_.insert(p.polygon).second) visit(p);
    return false;
  });
}

bool CityGmlWalk::any(const CityGmlMember& member, const std::function<bool(const CityGmlPolygon&)>& is_it) {
  return walk(member, [&](const ReachedPolygon& p) { return is_it(*p.polygon); });
}

bool CityGmlWalk::walk(const CityGmlMember& member, const IsEnough& is_enough) {
  levels_.clear();
  bool is_found = step(own_, member, is_enough);
  while (!is_found && !levels_.empty()) {
    Level& level = levels_.back();
    if (level.next == level.end)
      levels_.pop_back();
    else
      is_found = step(*level.home, level.home->members[level.next++], is_enough);
  }
  if (is_found)
    for (const Level& level : levels_) *level.is_found = true;
  return is_found;
}

bool CityGmlWalk::step(const CityGmlSurfaces& home, const CityGmlMember& member, const IsEnough& is_enough) {
  if (&home == &foreign_ && foreign_left_ == 0) return false;
  if (&home == &foreign_) --foreign_left_;
  if (!member.polygon) return enter(member.href);
  return is_enough({&home.polygons[*member.polygon], &home == &foreign_});
}

bool CityGmlWalk::enter(const std::string& href) {
  const std::string id = href.starts_with('#') ? href.substr(1) : std::string();
  for (const CityGmlSurfaces* there : {&own_, &foreign_})
    if (const auto found = there->ranges.find(id); !id.empty() && found != there->ranges.end()) {
      const auto [entry, is_new] = entered_.try_emplace(id, false);
      if (!is_new) return entry->second;
      levels_.push_back({there, found->second.begin, found->second.end, &entry->second});
      return false;
    }
  dangling_.push_back(href);
  return false;
}

}  // namespace farlod
