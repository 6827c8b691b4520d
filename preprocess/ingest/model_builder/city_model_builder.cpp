// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/model_builder/city_model_builder.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace farlod::ingest {
namespace {

bool is_wanted(double lod, LodChoice choice) {
  const double whole = std::floor(lod);
  return choice.exactly ? whole == static_cast<double>(*choice.exactly) : whole >= 1.0 && whole <= 3.0;
}

std::optional<double> best_of(const std::vector<double>& lods, LodChoice choice) {
  std::optional<double> best;
  for (const double lod : lods)
    if (is_wanted(lod, choice) && (!best || lod > *best)) best = lod;
  return best;
}

}  // namespace

std::vector<std::optional<double>> choose_lods(std::span<const std::vector<double>> lods_of_parts, LodChoice choice) {
  std::vector<std::optional<double>> chosen;
  for (const std::vector<double>& lods : lods_of_parts) chosen.push_back(best_of(lods, choice));
  const auto best = std::max_element(chosen.begin(), chosen.end());
  if (best == chosen.end() || !*best) return chosen;
  const double level = **best;
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    const std::vector<double>& lods = lods_of_parts[part];
    if (std::find(lods.begin(), lods.end(), level) != lods.end())
      chosen[part] = level;
    else if (part == 0)
      chosen[part].reset();
  }
  return chosen;
}

std::string list_lods(std::span<const std::vector<double>> lods_of_parts) {
  std::set<double> all;
  for (const std::vector<double>& lods : lods_of_parts) all.insert(lods.begin(), lods.end());
  std::ostringstream text;
  for (const double lod : all) text << (lod == *all.begin() ? "" : ", ") << lod;
  return all.empty() ? "none" : text.str();
}

std::string unused_polygons(std::size_t count, std::span<const std::vector<double>> lods_of_parts) {
  return std::to_string(count) + " polygons of other levels are not used; it has LoD " + list_lods(lods_of_parts);
}

namespace {

/// Twice the area that a ring encloses in plan; positive when it runs counter-clockwise.
double signed_double_area(const Ring& ring) {
  // Coordinates are relative to the first point. Far from the origin, the rounding of the products would exceed the area
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Point3d a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

void orient_footprint(Rings& rings) {
  for (std::size_t k = 0; k < rings.size(); ++k)
    if ((signed_double_area(rings[k]) < 0.0) == (k == 0)) std::reverse(rings[k].begin(), rings[k].end());
}

void lift(Rings& rings, double z_m) {
  for (Ring& ring : rings)
    for (Point3d& p : ring) p.z = z_m;
}

std::string counted(std::size_t n, const char* thing) { return std::to_string(n) + " " + thing + (n == 1 ? "" : "s"); }

}  // namespace

void CityModelBuilder::begin_building(std::string id, HeightReference height_reference, Foot foot) {
  id_ = std::move(id);
  ++buildings_met_;
  next_surface_ = 0;
  repeated_vertices_ = open_rings_ = 0;
  largest_gap_ = 0.0;
  at_repeating_ring_ = at_largest_gap_ = first_vertex_ = std::nullopt;
  added_.clear();
  origins_.clear();
  surface_ids_.clear();
  object_of_surface_.clear();
  problems_before_ = report_.problems().size();
  city_.begin_building(id_, height_reference, 0, foot);
  if (repeated_ids_ == RepeatedIds::reported && !ids_.insert(id_).second) report_.add(repeated_id(id_, {}));
}

Problem CityModelBuilder::repeated_id(std::string id, std::optional<Point3d> position) const {
  return {ProblemCode::repeated_id, source_, std::move(id), "an earlier building of this file has the same id", position};
}

void CityModelBuilder::add_problem(ProblemCode code, std::string detail, std::optional<Point3d> position, std::string ring) {
  report_.add({.code = code,
               .source = source_,
               .place = id_,
               .detail = std::move(detail),
               .position = position,
               .ring = std::move(ring)});
}

void CityModelBuilder::add_problem_at(std::string place, ProblemCode code, std::string detail, std::optional<Point3d> position) {
  report_.add({code, source_, std::move(place), std::move(detail), position});
}

std::string CityModelBuilder::name_of_ring(std::string_view polygon, std::size_t k) const {
  return "polygon " + (polygon.empty() ? std::to_string(next_surface_) : std::string(polygon)) + ", ring " + std::to_string(k) +
         (k == 0 ? " (outer)" : " (hole)");
}

bool CityModelBuilder::clean(Ring& ring, RingEnd end, std::string_view polygon, std::size_t k) {
  const std::size_t points = ring.size();
  const std::optional<Point3d> position = first_readable({&ring, 1});
  if (!first_vertex_) first_vertex_ = position;
  const RingFindings findings = clean_ring(ring, end);
  if (findings.state == RingState::usable) {
    note_repairs(findings, position, polygon, k);
    return true;
  }
  const std::string ring_name = name_of_ring(polygon, k);
  if (findings.state == RingState::too_few_points)
    add_problem(ProblemCode::too_few_points, ring_name + ": of its " + counted(points, "point") + " fewer than three differ",
                position, ring_name);
  else
    add_problem(ProblemCode::unreadable_coordinate, ring_name + ": a coordinate is missing, not a number, or beyond the Earth",
                position, ring_name);
  return false;
}

void CityModelBuilder::note_repairs(const RingFindings& findings, const std::optional<Point3d>& position,
                                    std::string_view polygon, std::size_t k) {
  if (findings.repeated_vertices > 0 && repeated_vertices_ == 0) {
    repeating_ring_ = name_of_ring(polygon, k);
    at_repeating_ring_ = position;
  }
  repeated_vertices_ += findings.repeated_vertices;
  if (findings.gap > largest_gap_) {
    widest_open_ring_ = name_of_ring(polygon, k);
    at_largest_gap_ = position;
  }
  open_rings_ += findings.was_open ? 1 : 0;
  largest_gap_ = std::max(largest_gap_, findings.gap);
}

bool CityModelBuilder::clean_polygon(Rings& rings, RingEnd end, std::string_view name) {
  if (rings.empty()) rings.emplace_back();
  if (!clean(rings.front(), end, name, 0)) return false;
  std::size_t k = 0;
  const auto unusable = [&](Ring& hole) { return !clean(hole, end, name, ++k); };
  rings.erase(std::remove_if(rings.begin() + 1, rings.end(), unusable), rings.end());
  return true;
}

void CityModelBuilder::add_facet(const Rings& rings, SurfaceKind kind, std::uint32_t surface, std::uint16_t part,
                                 std::uint32_t object) {
  if (object != 0) {
    object_of_surface_.resize(std::size_t{surface} + 1);
    object_of_surface_[surface] = object;
    origins_.push_back({surface, object});
  }
  city_.begin_facet(kind, surface, part);
  for (const Ring& ring : rings) city_.add_ring(ring);
}

std::optional<std::uint32_t> CityModelBuilder::add_polygon(Rings& rings, RingEnd end, const PolygonTraits& traits) {
  std::optional<std::uint32_t> surface;
  if (clean_polygon(rings, end, traits.name)) {
    surface = add_once(rings, traits);
    add_origin(*surface, traits.origin);
    note_id(*surface, traits.id);
  }
  ++next_surface_;
  return surface;
}

void CityModelBuilder::add_origin(std::uint32_t surface, const PolygonOrigin& origin) {
  const std::uint32_t object = surface < object_of_surface_.size() ? object_of_surface_[surface] : 0;
  if (!origin.semantics) return;
  // What add_facet has noted down of the surface without semantics
  if (!origins_.empty() && origins_.back().surface == surface && !origins_.back().semantics)
    origins_.back().semantics = origin.semantics;
  else
    origins_.push_back({surface, object, origin.semantics});
}

std::uint32_t CityModelBuilder::add_once(const Rings& rings, const PolygonTraits& traits) {
  const auto rings_of_facet = [this](std::uint64_t facet) {
    const Facet& f = city_.facets()[facet];
    std::vector<std::span<const Point3d>> spans;
    for (std::uint32_t k = 0; k < f.ring_count; ++k) spans.push_back(city_.ring(f, k));
    return spans;
  };
  if (const auto same = added_.find_or_insert(rings, traits.part, city_.facets().size(), rings_of_facet)) {
    const std::string ring = name_of_ring(traits.name, 0);
    const std::uint32_t first = city_.facets()[*same].surface;
    add_problem(
        ProblemCode::duplicate_surface,
        ring + ": the building has a polygon with the same corners, the same way round, as its surface " + std::to_string(first),
        rings.front().front(), ring);
    return first;
  }
  const std::uint32_t surface = traits.surface.value_or(next_surface_);
  add_facet(rings, traits.kind, surface, traits.part, traits.origin.object);
  return surface;
}

void CityModelBuilder::add_walls(const Ring& ring, double base_m, double top_m, std::uint16_t part, std::uint32_t object) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    wall_.front() = {{a.x, a.y, base_m}, {b.x, b.y, base_m}, {b.x, b.y, top_m}, {a.x, a.y, top_m}};
    add_facet(wall_, SurfaceKind::wall, next_surface_++, part, object);
  }
}

bool CityModelBuilder::leaves_room_for_walls(double base_m, double top_m) {
  const bool is_on_earth = std::abs(base_m) <= farthest_coordinate;
  if (is_on_earth && base_m < top_m) return true;
  std::ostringstream detail;
  detail << "between its base at " << base_m << " and its top at " << top_m << " there is no room for walls";
  add_problem(is_on_earth ? ProblemCode::height_not_positive : ProblemCode::unreadable_coordinate, detail.str());
  return false;
}

void CityModelBuilder::add_prism(Rings& rings, RingEnd end, double base_m, double top_m, std::uint16_t part,
                                 std::uint32_t object) {
  lift(rings, top_m);
  if (!clean_polygon(rings, end, "footprint")) return;
  if (!leaves_room_for_walls(base_m, top_m)) return;
  orient_footprint(rings);
  add_facet(rings, SurfaceKind::roof, next_surface_++, part, object);
  for (const Ring& ring : rings) add_walls(ring, base_m, top_m, part, object);
  lift(rings, base_m);
  for (Ring& ring : rings) std::reverse(ring.begin(), ring.end());
  add_facet(rings, SurfaceKind::floor, next_surface_++, part, object);
}

void CityModelBuilder::report_repairs() {
  if (repeated_vertices_ > 0)
    add_problem(ProblemCode::repeated_vertex, "taken out: " + counted(repeated_vertices_, "repetition"), at_repeating_ring_,
                repeating_ring_);
  if (open_rings_ > 0) {
    std::ostringstream detail;
    detail << counted(open_rings_, "ring") << " closed; the last vertex is up to " << largest_gap_
           << " (units of the file) from the first";
    add_problem(ProblemCode::ring_not_closed, detail.str(), at_largest_gap_, widest_open_ring_);
  }
}

void CityModelBuilder::place_problems() {
  for (Problem& problem : report_.since(problems_before_))
    if (!problem.position) problem.position = first_vertex_;
}

package::BuildingOrigin CityModelBuilder::origin_among(const PlacesOfBuilding& places) {
  // Repetitions come later than what they repeat
  std::stable_sort(origins_.begin(), origins_.end(), [](const auto& a, const auto& b) { return a.surface < b.surface; });
  std::vector<bool> has_surfaces(places.objects.size()), is_used(places.semantics.size());
  has_surfaces[0] = true;
  for (const package::SurfaceOrigin& surface : origins_) {
    has_surfaces[surface.object] = true;
    if (surface.semantics) is_used[*surface.semantics] = true;
  }
  package::BuildingOrigin origin;
  const auto kept_rows = [](const auto& all, const std::vector<bool>& is_kept, auto& kept) {
    std::vector<std::uint32_t> rows(all.size());
    for (std::size_t n = 0; n < all.size(); ++n) {
      rows[n] = static_cast<std::uint32_t>(kept.size());
      if (is_kept[n]) kept.push_back(all[n]);
    }
    return rows;
  };
  const std::vector<std::uint32_t> objects = kept_rows(places.objects, has_surfaces, origin.objects);
  const std::vector<std::uint32_t> semantics = kept_rows(places.semantics, is_used, origin.semantics);
  for (package::SurfaceOrigin& surface : origins_) {
    surface.object = objects[surface.object];
    if (surface.semantics) surface.semantics = semantics[*surface.semantics];
  }
  origin.surfaces = std::move(origins_);
  return origin;
}

void CityModelBuilder::note_id(std::uint32_t surface, std::string_view id) {
  // CityJSON may escape a byte 0, which no other text has
  if (id.empty() || id.size() > package::most_id_bytes || id.front() == '\0') return;
  // Most ids that a program has made begin with that of the building, which the package has
  const bool is_behind = !id_.empty() && id.starts_with(id_);
  surface_ids_.push_back({surface, surface + 1, std::string(id.substr(is_behind ? id_.size() : 0)), is_behind});
}

std::vector<package::SurfaceIds> CityModelBuilder::take_ids() {
  // A polygon that the file repeats comes later than what it repeats, whose id stays
  std::stable_sort(surface_ids_.begin(), surface_ids_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::vector<package::SurfaceIds> ids;
  for (package::SurfaceIds& next : surface_ids_) {
    if (!ids.empty() && next.begin < ids.back().end) continue;
    if (!ids.empty() && next.begin == ids.back().end && next.id == ids.back().id &&
        next.behind_building_id == ids.back().behind_building_id)
      ids.back().end = next.end;
    else
      ids.push_back(std::move(next));
  }
  return ids;
}

void CityModelBuilder::end_building(std::string_view missing, const PlacesOfBuilding* places) {
  report_repairs();
  if (city_.buildings().back().facet_count > 0 && (places != nullptr || !surface_ids_.empty())) {
    // The building itself has no place in a file that has none
    PlacesOfBuilding nowhere;
    nowhere.objects.emplace_back();
    if (places == nullptr) origins_.clear();
    package::BuildingOrigin origin = origin_among(places != nullptr ? *places : nowhere);
    origin.ids = take_ids();
    std::vector<std::uint8_t> bytes;
    package::append_origin(bytes, origin);
    city_.set_origin(bytes);
  }
  if (city_.buildings().back().facet_count == 0) {
    city_.drop_last_building();
    add_problem(ProblemCode::no_geometry, std::string(missing));
  }
  place_problems();
  if (repeated_ids_ == RepeatedIds::reported_by_append)
    unchecked_ids_.push_back({std::move(id_), problems_before_, first_vertex_});
}

void CityModelBuilder::append(CityModelBuilder&& next) {
  const std::span<Problem> problems = next.report_.since(0);
  std::size_t taken = 0;
  const auto take_problems_before = [&](std::size_t end) {
    for (; taken < end; ++taken) report_.add(std::move(problems[taken]));
  };
  for (UncheckedId& building : next.unchecked_ids_) {
    take_problems_before(building.problems_before);
    const auto [id, is_new] = ids_.insert(std::move(building.id));
    if (!is_new) report_.add(repeated_id(*id, building.first_vertex));
  }
  take_problems_before(problems.size());
  buildings_met_ += next.buildings_met_;
  city_.append(std::move(next.city_));
}

}  // namespace farlod::ingest
