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

void AreaAnswers::add(const SurfacePoint& r, const WantedIrradiation& wanted) {
  svf_.add(*r.svf, r.area_m2);
  further_.resize(r.further.size());
  for (std::size_t n = 0; n < r.further.size(); ++n)
    if (!std::isnan(r.further[n])) further_[n].add(static_cast<double>(r.further[n]), r.area_m2);
  if (!wanted.column) return;
  const auto kwh_m2 = static_cast<double>(r.further[*wanted.column]);
  if (!irradiation_) irradiation_.emplace();
  irradiation_->kwh += kwh_m2 * r.area_m2;
  if (!wanted.threshold_kwh_m2) return;
  const double above_m2 = kwh_m2 >= *wanted.threshold_kwh_m2 ? r.area_m2 : 0.0;
  irradiation_->area_above_m2 = irradiation_->area_above_m2.value_or(0.0) + above_m2;
}

std::vector<double> AreaAnswers::further() const {
  std::vector<double> means;
  for (const AreaMean& mean : further_) means.push_back(mean.value().value_or(std::nan("")));
  return means;
}

void SurfaceAverages::add(PlaceInRun place, const SurfacePoint& r) {
  const auto [entry, is_new] = places_.try_emplace({r.building, r.surface}, surfaces_.size());
  if (is_new) surfaces_.push_back({place, {r.building, r.surface, r.kind, r.azimuth, r.tilt}, {}});
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
  surface.answers.add(r, wanted_);
  add_extremes(surface.row, *r.svf);
}

std::vector<SurfaceMean> SurfaceAverages::rows() const {
  std::vector<SurfaceMean> rows;
  for (const Surface* surface : in_order(surfaces_)) {
    rows.push_back(surface->row);
    rows.back().svf_mean = surface->answers.svf();
    rows.back().further_mean = surface->answers.further();
    rows.back().irradiation = surface->answers.irradiation();
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
  (is_roof ? building.roofs : building.walls).add(r, wanted_);
}

std::vector<BuildingMean> BuildingAverages::rows() const {
  std::vector<BuildingMean> rows;
  for (const Building* building : in_order(buildings_)) {
    BuildingMean& row = rows.emplace_back(building->row);
    row.svf_roofs = building->roofs.svf();
    row.svf_walls = building->walls.svf();
    row.building_numbers.assign(building->numbers.begin(), building->numbers.end());
    row.further_roofs = building->roofs.further();
    row.further_walls = building->walls.further();
    row.roof_irradiation = building->roofs.irradiation();
    row.wall_irradiation = building->walls.irradiation();
  }
  return rows;
}

}  // namespace farlod
