// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_building.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace farlod {
namespace {

bool is_readable(double coordinate) { return std::abs(coordinate) <= 1e9; }  // false for NaN

/// Whether a polygon makes its level of detail eligible. Two dimensions are enough.
bool is_usable(const CityGmlPolygon& polygon) {
  if (!polygon.has_number || polygon.rings.empty()) return false;
  const FileRing& outer = polygon.rings.front();
  const auto height_of = [](const Point3d& p) { return std::isnan(p.z) ? 0.0 : p.z; };
  std::set<std::array<double, 3>> corners;
  for (const Point3d& p : outer) {
    if (!is_readable(p.x) || !is_readable(p.y) || !is_readable(height_of(p))) return false;
    corners.insert({p.x + 0.0, p.y + 0.0, height_of(p) + 0.0});
  }
  return corners.size() >= 3;
}

class CityGmlNumbering {
 public:
  CityGmlNumbering(CityGmlBuildingText text, const CityGmlSurfaces& foreign, std::size_t& foreign_left)
      : text_(std::move(text)), foreign_(foreign), foreign_left_(foreign_left) {}

  FileBuilding of(PackedLod lod) {
    chosen_ = chosen_lods(usable_lods(), lod);
    // Semantic surfaces come first, so that of two equal polygons the one in the solid is the copy
    collect(false);
    const std::size_t before_shells = wanted_.size();
    collect(true);
    has_shells_ = wanted_.size() > before_shells;
    for (const Wanted& polygon : wanted_)
      if (!is_copy(polygon) && polygon.reached.polygon->has_number) add(polygon);
    return std::move(text_.building);
  }

 private:
  struct Wanted {
    ReachedPolygon reached;
    const CityGmlUse* use = nullptr;
  };

  [[nodiscard]] bool can_be_used(const CityGmlUse& use) const {
    return use.role != CityGmlRole::inside && (!use.placement || text_.placements[*use.placement].has_value());
  }

  [[nodiscard]] LodsOfParts usable_lods() {
    LodsOfParts lods =
        lods_of([](CityGmlRole role) { return role != CityGmlRole::installation && role != CityGmlRole::element; });
    const bool has_any = std::ranges::any_of(lods, [](const auto& of_part) { return !of_part.empty(); });
    return has_any ? lods : lods_of([](CityGmlRole role) { return role == CityGmlRole::element; });
  }

  template <class Decides>
  [[nodiscard]] LodsOfParts lods_of(const Decides& decides) {
    LodsOfParts lods(text_.parts + 1);
    CityGmlWalk walk(text_.surfaces, foreign_, foreign_left_);
    for (const CityGmlMember& member : text_.surfaces.members) {
      const CityGmlUse& use = text_.uses[member.use];
      std::vector<double>& of_part = lods[use.part];
      if (decides(use.role) && can_be_used(use) && std::ranges::count(of_part, use.lod) == 0 && walk.any(member, is_usable))
        of_part.push_back(use.lod);
    }
    return lods;
  }

  void collect(bool shells) {
    for (const CityGmlMember& member : text_.surfaces.members) {
      const CityGmlUse& use = text_.uses[member.use];
      const bool is_chosen = can_be_used(use) && chosen_[use.part] && *chosen_[use.part] == use.lod;
      if ((use.role == CityGmlRole::shell) != shells || !is_chosen) continue;
      CityGmlWalk& walk = walks_.try_emplace(use.placement, text_.surfaces, foreign_, foreign_left_).first->second;
      walk.each(member, [&](const ReachedPolygon& reached) { want({reached, &use}); });
    }
  }

  void want(const Wanted& polygon) {
    if (polygon.use->placement && foreign_left_ == 0) return;
    if (polygon.use->placement) --foreign_left_;
    wanted_.push_back(polygon);
  }

  /// Whether a polygon of a shell repeats the corners of an earlier polygon of its part.
  [[nodiscard]] bool is_copy(const Wanted& polygon) {
    if (!has_shells_ || polygon.use->placement) return false;
    const bool is_first = seen_.emplace(polygon.use->part, corners_of(polygon.reached.polygon->rings)).second;
    return !is_first && polygon.use->role == CityGmlRole::shell;
  }

  void add(const Wanted& polygon) {
    const CityGmlUse& use = *polygon.use;
    NumberedPolygon& added = text_.building.polygons.emplace_back(NumberedPolygon{next_number_++, use.object, std::nullopt});
    if (!use.placement && !polygon.reached.is_foreign) added.semantics = use.semantics;
    const FileRings& rings = polygon.reached.polygon->rings;
    measure(use.placement ? text_.placements[*use.placement]->place(rings) : rings, added);
  }

  CityGmlBuildingText text_;
  const CityGmlSurfaces& foreign_;
  std::size_t& foreign_left_;
  std::vector<std::optional<double>> chosen_;
  std::map<std::optional<std::size_t>, CityGmlWalk> walks_;  ///< one for each placement, which places the same surfaces again
  std::vector<Wanted> wanted_;
  bool has_shells_ = false;
  std::set<std::pair<std::size_t, FileCorners>> seen_;
  std::uint32_t next_number_ = 0;
};

}  // namespace

std::optional<PrototypePlacement> PrototypePlacement::from(std::span<const double> m, const Point3d& reference_point) {
  PrototypePlacement placement;
  placement.origin_ = reference_point;
  if (m.empty()) return placement;
  if (m.size() != 16 || !std::ranges::all_of(m, [](double x) { return std::isfinite(x); })) return std::nullopt;
  placement.x_axis_ = {m[0], m[4], m[8]};
  placement.y_axis_ = {m[1], m[5], m[9]};
  placement.z_axis_ = {m[2], m[6], m[10]};
  placement.origin_ = Point3d{m[3], m[7], m[11]} + reference_point;
  return placement;
}

FileRings PrototypePlacement::place(const FileRings& rings) const {
  FileRings placed = rings;
  for (FileRing& ring : placed)
    for (Point3d& p : ring) p = origin_ + p.x * x_axis_ + p.y * y_axis_ + p.z * z_axis_;
  return placed;
}

FileBuilding numbered(CityGmlBuildingText text, const CityGmlSurfaces& foreign, PackedLod lod, std::size_t& foreign_left) {
  return CityGmlNumbering(std::move(text), foreign, foreign_left).of(lod);
}

}  // namespace farlod
