// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_building.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "ingest/model_builder/polygon_deduplicator.hpp"

namespace farlod::ingest {
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
    builder_.add_polygon(rings, RingEnd::repeats_first,
                         {.kind = p.use->kind, .part = p.use->part, .surface = {}, .name = polygon.id, .origin = origin_of(p)});
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

}  // namespace farlod::ingest
