// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_building.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/expects.hpp"

namespace farlod::ingest {

std::optional<Placement> Placement::from(std::span<const double> m, const Point3d& reference_point) {
  if (m.empty()) return Placement({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, reference_point);
  if (m.size() != 16 || !std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); })) return std::nullopt;
  return Placement({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, Point3d{m[3], m[7], m[11]} + reference_point);
}

Point3d Placement::place(const Point3d& p) const { return origin_ + p.x * x_axis_ + p.y * y_axis_ + p.z * z_axis_; }

Rings Placement::place(const Rings& rings_prototype) const {
  const bool mirrors = dot(cross(x_axis_, y_axis_), z_axis_) < 0.0;
  Rings rings = rings_prototype;
  for (Ring& ring : rings) {
    for (Point3d& p : ring) p = place(p);
    if (mirrors) std::reverse(ring.begin(), ring.end());
  }
  return rings;
}

namespace {

struct WantedPolygon {
  ResolvedPolygon resolved;
  const SurfaceUse* use = nullptr;
};

bool is_usable(const GmlPolygon& polygon) {
  if (polygon.has_curves || polygon.is_too_long || polygon.rings.empty()) return false;
  Ring outer = polygon.rings.front();
  for (Point3d& p : outer) p.z = std::isnan(p.z) ? 0.0 : p.z;
  return clean_ring(outer, RingEnd::repeats_first).state == RingState::usable;
}

/// Whether a surface of this role makes its level of detail eligible. A chimney alone does not.
bool makes_a_building(SurfaceRole role) { return role != SurfaceRole::installation && role != SurfaceRole::element; }

bool is_element(SurfaceRole role) { return role == SurfaceRole::element; }

class BuildingAssembler {
 public:
  BuildingAssembler(const CityGmlBuilding& building, const GmlSurfaces& foreign, ReferenceBudget& budget,
                    CityModelBuilder& builder)
      : building_(building), foreign_(foreign), budget_(budget), builder_(builder) {}

  void add(LodChoice lod, const PlacesOfBuilding* places) {
    const std::vector<std::vector<double>> lods = usable_lods();
    chosen_ = choose_lods(lods, lod);
    builder_.begin_building(building_.id);
    collect_wanted();
    report_unread();
    // Where references alone lead to the shell, as in most files, nothing can be a copy
    const bool has_shells = std::any_of(wanted_.begin(), wanted_.end(), is_of_shell);
    for (const WantedPolygon& p : wanted_)
      if (!has_shells || !is_copy(p)) add(p);
    report_other_lods(lods);
    builder_.end_building("no usable surface in the level of detail asked for; it has LoD " + list_lods(lods), places);
  }

 private:
  static bool is_of_shell(const WantedPolygon& p) { return p.use->role == SurfaceRole::shell; }

  bool can_be_used(const SurfaceUse& use) const {
    return use.role != SurfaceRole::inside && (!use.placement || building_.placements[*use.placement].has_value());
  }

  std::vector<std::vector<double>> usable_lods() {
    std::vector<std::vector<double>> lods = usable_lods(makes_a_building);
    const bool has_none = std::all_of(lods.begin(), lods.end(), [](const auto& of_part) { return of_part.empty(); });
    return has_none ? usable_lods(is_element) : lods;
  }

  std::vector<std::vector<double>> usable_lods(bool (*counts)(SurfaceRole)) {
    std::vector<std::set<double>> found(building_.measured_height_m.size());
    ReferenceWalk walk(building_.surfaces, foreign_, budget_);
    for (const GmlMember& member : building_.surfaces.members) {
      const SurfaceUse& use = building_.uses[member.use];
      std::set<double>& lods = found[use.part];
      if (counts(use.role) && can_be_used(use) && !lods.contains(use.lod) && walk.any(member, is_usable)) lods.insert(use.lod);
    }
    std::vector<std::vector<double>> lods;
    lods.reserve(found.size());
    for (const std::set<double>& of_part : found) lods.emplace_back(of_part.begin(), of_part.end());
    return lods;
  }

  bool is_chosen(const SurfaceUse& use) const { return can_be_used(use) && chosen_[use.part] && *chosen_[use.part] == use.lod; }

  /// Semantic surfaces come first, so that of two equal polygons the one in the solid is the copy.
  void collect_wanted() {
    std::map<std::optional<std::size_t>, ReferenceWalk> walks;  // one for each placement: it places the same surfaces again
    for (const bool shells : {false, true})
      for (const GmlMember& member : building_.surfaces.members) {
        const SurfaceUse& use = building_.uses[member.use];
        if ((use.role == SurfaceRole::shell) != shells || !is_chosen(use)) continue;
        ReferenceWalk& walk = walks.try_emplace(use.placement, building_.surfaces, foreign_, budget_).first->second;
        walk.each(member, [&](const ResolvedPolygon& p) { want({p, &use}); });
      }
    for (const auto& [placement, walk] : walks) dangling_.insert(walk.dangling().begin(), walk.dangling().end());
  }

  void want(const WantedPolygon& p) {
    if (p.use->placement && !budget_.take(p.resolved.polygon->point_count())) return;
    if (p.use->role == SurfaceRole::footprint && is_usable(*p.resolved.polygon)) parts_with_footprint_.insert(p.use->part);
    wanted_.push_back(p);
  }

  /// Whether a polygon of a shell repeats an earlier polygon of its part. Semantic surfaces and installations are never copies of
  /// each other, since two of them may share a wall.
  bool is_copy(const WantedPolygon& p) {
    if (p.use->placement) return false;
    const Rings& rings = p.resolved.polygon->rings;
    const auto rings_at = [this](std::uint64_t number) { return spans_of(*compared_[number]); };
    compared_.push_back(&rings);
    const bool is_first = !seen_.find_or_insert(rings, p.use->part, compared_.size() - 1, rings_at);
    return !is_first && is_of_shell(p);
  }

  void add(const WantedPolygon& p) {
    const GmlPolygon& polygon = *p.resolved.polygon;
    if (const std::string flaw = flaw_of(polygon); !flaw.empty()) {
      builder_.add_problem(ProblemCode::unsupported_geometry, "polygon " + polygon.id + flaw);
      return;
    }
    Rings rings = p.use->placement ? building_.placements[*p.use->placement]->place(polygon.rings) : polygon.rings;
    if (p.use->lod == 0) return add_footprint(rings, *p.use);
    if (p.resolved.is_reversed)
      for (Ring& ring : rings) std::reverse(ring.begin(), ring.end());
    builder_.add_polygon(
        rings, RingEnd::repeats_first,
        {.kind = p.use->kind, .part = p.use->part, .surface = {}, .name = polygon.id, .origin = origin_of(p), .id = id_of(p)});
  }

  /// Analysts know the semantic surface, which databases keep; a polygon is called where that has no name.
  std::string_view id_of(const WantedPolygon& p) const {
    const PolygonOrigin origin = origin_of(p);
    const std::string_view semantic = origin.semantics ? std::string_view(building_.semantic_ids[*origin.semantics]) : "";
    return semantic.empty() ? std::string_view(p.resolved.polygon->id) : semantic;
  }

  /// What many objects share is of none of their semantic surfaces.
  static PolygonOrigin origin_of(const WantedPolygon& p) {
    PolygonOrigin origin = p.use->origin;
    if (p.use->placement || p.resolved.is_foreign) origin.semantics.reset();
    return origin;
  }

  static std::string flaw_of(const GmlPolygon& polygon) {
    if (polygon.has_curves) return " is bounded by a curve";
    if (polygon.is_too_long) return " has a ring of more than " + std::to_string(most_points_of_ring) + " points";
    return "";
  }

  /// LoD 0 has no volume: a footprint is raised by the measured height, a roof edge lowered by it.
  void add_footprint(Rings& rings, const SurfaceUse& use) {
    if (use.role == SurfaceRole::roof_edge && parts_with_footprint_.contains(use.part)) return;
    const std::optional<double> height_m = building_.measured_height_m[use.part];
    const double z = rings.empty() || rings.front().empty() ? 0.0 : rings.front().front().z;
    if (!height_m || std::isnan(z))
      builder_.add_problem(ProblemCode::no_height, std::isnan(z) ? "its LoD 0 has no elevation" : "LoD 0 needs a measuredHeight",
                           first_readable(rings));
    else if (!(*height_m > 0.0))
      builder_.add_problem(ProblemCode::height_not_positive, "its measuredHeight is " + std::to_string(*height_m),
                           first_readable(rings));
    else
      builder_.add_prism(rings, RingEnd::repeats_first, use.role == SurfaceRole::roof_edge ? z - *height_m : z,
                         use.role == SurfaceRole::roof_edge ? z : z + *height_m, use.part, use.origin.object);
  }

  void report_unread() {
    for (const std::string& href : dangling_)
      builder_.add_problem(ProblemCode::dangling_reference, "the reference " + href + " leads to nothing in the file");
    for (const auto& [what, times] : building_.unread)
      builder_.add_problem(ProblemCode::unsupported_geometry,
                           what + " is not read" + (times > 1 ? " (" + std::to_string(times) + " times)" : ""));
    if (budget_.refusals() > refusals_before_)
      builder_.add_problem(ProblemCode::unsupported_geometry,
                           "some of what it refers to is left out: the references of this file have brought in " +
                               std::to_string(budget_.most_points()) + " points, and no more are read");
  }

  void report_other_lods(const std::vector<std::vector<double>>& lods) {
    if (std::none_of(chosen_.begin(), chosen_.end(), [](const std::optional<double>& lod) { return lod.has_value(); })) return;
    std::size_t others = 0;
    ReferenceWalk walk(building_.surfaces, foreign_, budget_);
    for (const GmlMember& member : building_.surfaces.members)
      if (const SurfaceUse& use = building_.uses[member.use]; can_be_used(use) && !is_chosen(use))
        walk.each(member, [&](const ResolvedPolygon&) { ++others; });
    if (others > 0) builder_.add_problem(ProblemCode::other_level_of_detail, unused_polygons(others, lods));
  }

  const CityGmlBuilding& building_;
  const GmlSurfaces& foreign_;
  ReferenceBudget& budget_;
  const std::size_t refusals_before_ = budget_.refusals();
  CityModelBuilder& builder_;
  std::vector<std::optional<double>> chosen_;
  std::vector<WantedPolygon> wanted_;
  std::set<std::uint16_t> parts_with_footprint_;
  std::set<std::string> dangling_;
  PolygonDeduplicator seen_{SamePolygon::corners};
  std::vector<const Rings*> compared_;  ///< by their numbers in `seen_`
};

}  // namespace

void CityGmlBuilding::add_unread(std::string what) {
  constexpr std::size_t most_kinds = 16;
  const bool is_told_apart = unread.size() < most_kinds || unread.contains(what);
  ++unread[is_told_apart ? std::move(what) : "geometry of still other kinds"];
}

std::vector<std::string> foreign_references(const CityGmlBuilding& building) {
  const GmlSurfaces none;
  ReferenceBudget budget(none);
  ReferenceWalk walk(building.surfaces, none, budget);
  for (const GmlMember& member : building.surfaces.members)
    if (!member.polygon) walk.each(member, [](const ResolvedPolygon&) {});
  return walk.dangling();
}

void add_building(const CityGmlBuilding& building, const GmlSurfaces& foreign, LodChoice lod, ReferenceBudget& budget,
                  CityModelBuilder& builder, const PlacesOfBuilding* places) {
  BuildingAssembler(building, foreign, budget, builder).add(lod, places);
}

namespace {

/// One more than a matrix has, so that a longer list is noticed.
constexpr std::size_t most_numbers = 17;

/// Longitudes end at 180. No known projected city is that close to the origin of its CRS.
bool reads_like_degrees(const Point3d& p) { return std::abs(p.x) <= 180.0 && std::abs(p.y) <= 180.0; }

}  // namespace

void PrototypeReader::begin(std::string_view property, const SurfaceUse& use) {
  property_ = property;
  use_ = use;
  matrix_.clear();
  position_.clear();
  is_elsewhere_ = has_surfaces_ = false;
}

bool PrototypeReader::start(std::string_view name) {
  if (name == "transformationMatrix")
    numbers_ = &matrix_;
  else if (name == "pos" || name == "coordinates")
    numbers_ = &position_;
  else
    return false;
  numbers_->clear();
  return true;
}

void PrototypeReader::text(std::string_view piece) {
  FARLOD_EXPECTS(numbers_ != nullptr);
  scanner_.take(piece, [this](double number) {
    if (numbers_->size() < most_numbers) numbers_->push_back(number);
  });
}

void PrototypeReader::end_numbers() {
  scanner_.end([this](double number) { numbers_->push_back(number); });
  numbers_ = nullptr;
}

std::optional<Placement> PrototypeReader::placement(bool has_crs, std::string& unread) const {
  unread = "a geometry by " + property_;
  if (!has_surfaces_) {
    if (is_elsewhere_) unread += " in another file (libraryObject)";
    return std::nullopt;
  }
  const bool has_position = position_.size() == 3 && std::isfinite(position_[0] + position_[1] + position_[2]);
  const Point3d reference_point = has_position ? Point3d{position_[0], position_[1], position_[2]} : Point3d{};
  const std::optional<Placement> placement = Placement::from(matrix_, reference_point);
  if (!has_position)
    unread += " without a readable referencePoint";
  else if (!placement)
    unread += " whose transformationMatrix is not 16 numbers";
  else if (has_crs && reads_like_degrees(reference_point))
    unread += " whose referencePoint is in degrees (its matrix counts in metres, so the file has to be in a projected CRS)";
  else
    return placement;
  return std::nullopt;
}

void ReliefReader::begin(const XmlElement& property) {
  dimension_ = property.srs_dimension == "2" ? 2 : 3;
  in_list_ = false;
}

bool ReliefReader::start(const XmlElement& element) {
  if (element.srs_dimension == "2") dimension_ = 2;
  if (element.srs_dimension == "3") dimension_ = 3;
  // The corners of an envelope are no points of the terrain
  if (in_list_ || element.name == "boundedBy") return false;
  if (element.name == "posList" || element.name == "pos" || element.name == "coordinates") {
    in_list_ = true;
    numbers_.clear();
    first_of_list_.reset();
    points_of_list_ = 0;
  }
  return true;
}

void ReliefReader::text(std::string_view piece) {
  if (in_list_) scanner_.take(piece, [this](double number) { take_number(number); });
}

void ReliefReader::end() {
  if (!in_list_) return;
  in_list_ = false;
  scanner_.end([this](double number) { take_number(number); });
  if (!numbers_.empty()) ++unreadable_points_;
  const bool is_closed = points_of_list_ > 1 && first_of_list_ == points_.back();
  if (is_closed) points_.pop_back();
}

void ReliefReader::append(const ReliefReader& next) {
  points_.insert(points_.end(), next.points_.begin(), next.points_.end());
  unreadable_points_ += next.unreadable_points_;
}

void ReliefReader::take_number(double number) {
  numbers_.push_back(number);
  if (numbers_.size() < dimension_) return;
  add_point();
  numbers_.clear();
}

void ReliefReader::add_point() {
  const std::optional<Point3d> p = dimension_ < 3 ? std::nullopt : std::optional(Point3d{numbers_[0], numbers_[1], numbers_[2]});
  if (!p || !is_readable(*p)) {
    ++unreadable_points_;
    return;
  }
  points_.push_back(*p);
  if (points_of_list_++ == 0) first_of_list_ = points_.back();
}

}  // namespace farlod::ingest
