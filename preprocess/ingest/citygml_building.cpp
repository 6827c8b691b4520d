// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml_building.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "ingest/seen_polygons.hpp"

namespace farlod {
namespace {

struct UsedPolygon {
  ResolvedPolygon resolved;
  const SurfaceUse* use = nullptr;
};

bool is_usable(const GmlPolygon& polygon) {
  if (polygon.has_curves || polygon.rings.empty()) return false;
  Ring outer = polygon.rings.front();
  for (Point3d& p : outer) p.z = std::isnan(p.z) ? 0.0 : p.z;
  return clean_ring(outer, RingEnd::repeats_first).state == RingState::usable;
}

/// Whether a level of detail may be chosen for the sake of such a surface: a lone chimney does not make a building.
bool makes_a_building(SurfaceRole role) { return role != SurfaceRole::installation; }

class BuildingWriter {
 public:
  BuildingWriter(const CityGmlBuilding& building, const GmlSurfaces& foreign, CityWriter& writer)
      : building_(building), foreign_(foreign), writer_(writer) {}

  void write(LodChoice lod) {
    resolve_all();
    const std::vector<std::vector<double>> lods = usable_lods();
    chosen_ = choose_lods(lods, lod);
    writer_.begin_building(building_.id);
    report_unread();
    std::set<const GmlPolygon*> others;
    for (const UsedPolygon& p : polygons_) {
      if (!is_chosen(*p.use))
        others.insert(p.resolved.polygon);
      else if (is_new(p))
        write(p);
    }
    if (has_chosen() && !others.empty())
      writer_.add_problem(ProblemCode::other_level_of_detail, unused_polygons(others.size(), lods));
    writer_.end_building("no usable surface in the level of detail asked for; it has LoD " + list_lods(lods));
  }

 private:
  /// Semantic surfaces come first, so that it is their copies in solids which are found to be copies.
  void resolve_all() {
    for (const bool shells : {false, true})
      for (const GmlMember& member : building_.surfaces.members) {
        const SurfaceUse& use = building_.uses[member.use];
        if ((use.role == SurfaceRole::shell) != shells) continue;
        std::vector<std::string> dangling;
        for (const ResolvedPolygon& p : resolve(member, building_.surfaces, foreign_, dangling)) polygons_.push_back({p, &use});
        for (std::string& href : dangling) dangling_.emplace_back(std::move(href), &use);
      }
  }

  std::vector<std::vector<double>> usable_lods() const {
    std::vector<std::set<double>> found(building_.measured_height_m.size());
    for (const UsedPolygon& p : polygons_) {
      std::set<double>& lods = found[p.use->part];
      const double lod = p.use->lod;
      if (makes_a_building(p.use->role) && !lods.contains(lod) && is_usable(*p.resolved.polygon)) lods.insert(lod);
    }
    std::vector<std::vector<double>> lods;
    for (const std::set<double>& of_part : found) lods.emplace_back(of_part.begin(), of_part.end());
    return lods;
  }

  bool is_chosen(const SurfaceUse& use) const { return chosen_[use.part] && *chosen_[use.part] == use.lod; }

  bool has_chosen() const {
    return std::any_of(chosen_.begin(), chosen_.end(), [](const std::optional<double>& lod) { return lod.has_value(); });
  }

  bool is_new(const UsedPolygon& p) {
    if (!written_.insert(p.resolved.polygon).second) return false;
    // Semantic surfaces and installations are never each other's copies: two parts may well share a wall
    const bool is_first = seen_by_part_[p.use->part].insert(p.resolved.polygon->rings);
    return is_first || p.use->role != SurfaceRole::shell;
  }

  void write(const UsedPolygon& p) {
    const GmlPolygon& polygon = *p.resolved.polygon;
    if (polygon.has_curves) {
      writer_.add_problem(ProblemCode::unsupported_geometry, "polygon " + polygon.id + " is bounded by a curve");
      return;
    }
    Rings rings = polygon.rings;
    if (p.use->lod == 0) return write_footprint(rings, *p.use);
    if (p.resolved.is_reversed)
      for (Ring& ring : rings) std::reverse(ring.begin(), ring.end());
    writer_.add_polygon(rings, RingEnd::repeats_first,
                        {.kind = p.use->kind, .part = p.use->part, .surface = {}, .name = polygon.id});
  }

  /// LoD 0 has no volume: a footprint is raised by the measured height, a roof edge lowered by it.
  void write_footprint(Rings& rings, const SurfaceUse& use) {
    if (use.role == SurfaceRole::roof_edge && has_footprint(use.part)) return;
    const std::optional<double> height_m = building_.measured_height_m[use.part];
    const double z = rings.empty() || rings.front().empty() ? 0.0 : rings.front().front().z;
    if (!height_m || std::isnan(z))
      writer_.add_problem(ProblemCode::no_height, std::isnan(z) ? "its LoD 0 has no elevation" : "LoD 0 needs a measuredHeight",
                          first_readable(rings));
    else if (!(*height_m > 0.0))
      writer_.add_problem(ProblemCode::height_not_positive, "its measuredHeight is " + std::to_string(*height_m),
                          first_readable(rings));
    else
      writer_.add_prism(rings, RingEnd::repeats_first, use.role == SurfaceRole::roof_edge ? z - *height_m : z,
                        use.role == SurfaceRole::roof_edge ? z : z + *height_m, use.part);
  }

  bool has_footprint(std::uint16_t part) const {
    return std::any_of(polygons_.begin(), polygons_.end(), [&](const UsedPolygon& p) {
      return p.use->part == part && p.use->role == SurfaceRole::footprint && is_usable(*p.resolved.polygon);
    });
  }

  void report_unread() {
    std::set<std::string> hrefs;
    for (const auto& [href, use] : dangling_)
      if (is_chosen(*use) && hrefs.insert(href).second)
        writer_.add_problem(ProblemCode::dangling_reference, "nothing in the file is called " + href);
    for (const std::string& what : building_.unread)
      writer_.add_problem(ProblemCode::unsupported_geometry, what + " is not read");
  }

  const CityGmlBuilding& building_;
  const GmlSurfaces& foreign_;
  CityWriter& writer_;
  std::vector<UsedPolygon> polygons_;
  std::vector<std::pair<std::string, const SurfaceUse*>> dangling_;
  std::vector<std::optional<double>> chosen_;
  std::set<const GmlPolygon*> written_;
  std::vector<SeenPolygons> seen_by_part_ = std::vector<SeenPolygons>(building_.measured_height_m.size());
};

}  // namespace

std::vector<std::string> foreign_references(const CityGmlBuilding& building) {
  std::vector<std::string> dangling;
  for (const GmlMember& member : building.surfaces.members) (void)resolve(member, building.surfaces, {}, dangling);
  return dangling;
}

void write_building(const CityGmlBuilding& building, const GmlSurfaces& foreign, LodChoice lod, CityWriter& writer) {
  BuildingWriter(building, foreign, writer).write(lod);
}

}  // namespace farlod
