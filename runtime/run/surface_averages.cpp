// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/surface_averages.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace farlod {
namespace {

void add_extremes(SurfaceMean& row, double svf) {
  row.svf_min = std::min(row.svf_min.value_or(svf), svf);
  row.svf_max = std::max(row.svf_max.value_or(svf), svf);
}

/// Pointers to the entries, in the order of their first receivers.
template <class Entry>
std::vector<const Entry*> in_order(const std::vector<Entry>& entries) {
  std::vector<const Entry*> order;
  for (const Entry& e : entries) order.push_back(&e);
  std::sort(order.begin(), order.end(), [](const Entry* a, const Entry* b) { return a->first < b->first; });
  return order;
}

}  // namespace

void SurfaceAverages::add(PlaceInRun place, const SurfacePoint& r) {
  const auto [entry, is_new] = places_.try_emplace({r.building, r.surface}, surfaces_.size());
  if (is_new) surfaces_.push_back({place, {r.building, r.surface, r.kind, r.azimuth, r.tilt}, {}, {}});
  Surface& surface = surfaces_[entry->second];
  if (place < surface.first) {
    surface.first = place;
    std::tie(surface.row.kind, surface.row.azimuth, surface.row.tilt) = std::tie(r.kind, r.azimuth, r.tilt);
  }
  ++surface.row.receivers;
  surface.row.nodata += r.svf ? 0 : 1;
  surface.row.covered_area_m2 += r.svf ? 0.0 : r.area_m2;
  if (!r.svf) return;
  surface.row.area_m2 += r.area_m2;
  surface.mean.add(*r.svf, r.area_m2);
  surface.further.resize(r.further.size());
  for (std::size_t n = 0; n < r.further.size(); ++n)
    if (!std::isnan(r.further[n])) surface.further[n].add(static_cast<double>(r.further[n]), r.area_m2);
  add_extremes(surface.row, *r.svf);
}

std::vector<SurfaceMean> SurfaceAverages::rows() const {
  std::vector<SurfaceMean> rows;
  for (const Surface* surface : in_order(surfaces_)) {
    rows.push_back(surface->row);
    rows.back().svf_mean = surface->mean.value();
    for (const AreaMean& mean : surface->further) rows.back().further_mean.push_back(mean.value().value_or(std::nan("")));
  }
  return rows;
}

void BuildingAverages::add(PlaceInRun place, const SurfacePoint& r) {
  const auto [entry, is_new] = places_.try_emplace(r.building, buildings_.size());
  if (is_new) buildings_.push_back({place, {r.building}, {}, {}, {}});
  Building& building = buildings_[entry->second];
  building.numbers.insert(r.building_number);
  building.first = std::min(building.first, place);
  const bool is_roof = r.kind == SurfaceKind::roof;
  ++building.row.receivers;
  building.row.nodata += r.svf ? 0 : 1;
  if (!r.svf) (is_roof ? building.row.covered_roof_area_m2 : building.row.covered_wall_area_m2) += r.area_m2;
  if (!r.svf) return;
  (is_roof ? building.row.roof_area_m2 : building.row.wall_area_m2) += r.area_m2;
  (is_roof ? building.roofs : building.walls).add(*r.svf, r.area_m2);
}

std::vector<BuildingMean> BuildingAverages::rows() const {
  std::vector<BuildingMean> rows;
  for (const Building* building : in_order(buildings_)) {
    rows.push_back(building->row);
    rows.back().svf_roofs = building->roofs.value();
    rows.back().svf_walls = building->walls.value();
    rows.back().building_numbers.assign(building->numbers.begin(), building->numbers.end());
  }
  return rows;
}

}  // namespace farlod
