// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/surface_averages.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace farlod {
namespace {

/// A mean weighted by area, over what has an answer.
struct AreaMean {
  double weighted = 0.0, area_m2 = 0.0;

  void add(double value, double area) {
    weighted += area * value;
    area_m2 += area;
  }
  [[nodiscard]] std::optional<double> value() const { return area_m2 > 0.0 ? std::optional(weighted / area_m2) : std::nullopt; }
};

void add_extremes(SurfaceRow& row, double svf) {
  row.svf_min = std::min(row.svf_min.value_or(svf), svf);
  row.svf_max = std::max(row.svf_max.value_or(svf), svf);
}

}  // namespace

std::vector<SurfaceRow> average_by_surface(std::span<const SurfacePointRow> receivers) {
  std::map<std::pair<std::string, std::uint32_t>, std::size_t> place;
  std::vector<SurfaceRow> rows;
  std::vector<AreaMean> means;
  for (const SurfacePointRow& r : receivers) {
    const auto [entry, is_new] = place.try_emplace({r.building, r.surface}, rows.size());
    if (is_new) {
      rows.push_back({r.building, r.surface, r.kind, r.azimuth, r.tilt, 0.0, 0, 0, {}, {}, {}});
      means.emplace_back();
    }
    SurfaceRow& row = rows[entry->second];
    row.area_m2 += r.area_m2;
    ++row.receivers;
    if (!r.svf) {
      ++row.nodata;
      continue;
    }
    means[entry->second].add(*r.svf, r.area_m2);
    add_extremes(row, *r.svf);
  }
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].svf_mean = means[n].value();
  return rows;
}

std::vector<BuildingRow> average_by_building(std::span<const SurfacePointRow> receivers) {
  std::map<std::string, std::size_t> place;
  std::vector<BuildingRow> rows;
  std::vector<std::pair<AreaMean, AreaMean>> roofs_and_walls;
  for (const SurfacePointRow& r : receivers) {
    const auto [entry, is_new] = place.try_emplace(r.building, rows.size());
    if (is_new) {
      rows.push_back({r.building, 0.0, 0.0, 0, 0, {}, {}});
      roofs_and_walls.emplace_back();
    }
    BuildingRow& row = rows[entry->second];
    const bool is_roof = r.kind == SurfaceKind::roof;
    (is_roof ? row.roof_area_m2 : row.wall_area_m2) += r.area_m2;
    ++row.receivers;
    row.nodata += r.svf ? 0 : 1;
    auto& [roofs, walls] = roofs_and_walls[entry->second];
    if (r.svf) (is_roof ? roofs : walls).add(*r.svf, r.area_m2);
  }
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows[n].svf_roofs = roofs_and_walls[n].first.value();
    rows[n].svf_walls = roofs_and_walls[n].second.value();
  }
  return rows;
}

}  // namespace farlod
