// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/area_columns.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace farlod {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Irradiation comes in kWh/m², and is summed over areas.
bool has_irradiation(const AnswerColumns& columns) {
  return std::ranges::find(columns.further, "irradiation", &ColumnDescription::name) != columns.further.end();
}

void add_means(const std::vector<double>& means, const std::string& ending, const AnswerColumns& columns,
               std::vector<AreaColumn>& list) {
  for (std::size_t k = 0; k < columns.further.size(); ++k)
    list.push_back({columns.further[k].name + ending, means.empty() ? no_number : means[k], NumberForm::shortest});
}

AreaColumn kwh_of(const std::optional<AreaIrradiation>& irradiation, const std::string& name) {
  return {name, irradiation ? irradiation->kwh : no_number, NumberForm::rounded};
}

AreaColumn area_above_of(const std::optional<AreaIrradiation>& irradiation, const std::string& name) {
  return {name, irradiation ? irradiation->area_above_m2.value_or(no_number) : no_number, NumberForm::rounded};
}

}  // namespace

BuildingAreas areas_of(const BuildingMean& b) {
  BuildingAreas areas;
  if (b.roof_area_m2 + b.covered_roof_area_m2 > 0.0) {
    areas.roofs_m2 = b.roof_area_m2;
    areas.covered_roofs_m2 = b.covered_roof_area_m2;
  }
  if (b.wall_area_m2 + b.covered_wall_area_m2 > 0.0) {
    areas.walls_m2 = b.wall_area_m2;
    areas.covered_walls_m2 = b.covered_wall_area_m2;
  }
  return areas;
}

bool have_ids(std::span<const SurfaceMean> surfaces) {
  return std::ranges::any_of(surfaces, [](const SurfaceMean& surface) { return !surface.id.empty(); });
}

std::vector<AreaColumn> area_columns_of(const SurfaceMean& surface, const AnswerColumns& columns) {
  std::vector<AreaColumn> list;
  add_means(surface.further_mean, "_mean", columns, list);
  if (!has_irradiation(columns)) return list;
  list.push_back(kwh_of(surface.irradiation, "irradiation_kwh"));
  if (columns.areas_above == ThresholdColumns::yes) list.push_back(area_above_of(surface.irradiation, "area_above_m2"));
  return list;
}

std::vector<AreaColumn> area_columns_of(const BuildingMean& building, const AnswerColumns& columns) {
  std::vector<AreaColumn> list;
  add_means(building.further_roofs, "_roofs", columns, list);
  add_means(building.further_walls, "_walls", columns, list);
  if (!has_irradiation(columns)) return list;
  list.push_back(kwh_of(building.roof_irradiation, "roof_irradiation_kwh"));
  list.push_back(kwh_of(building.wall_irradiation, "wall_irradiation_kwh"));
  if (columns.areas_above == ThresholdColumns::no) return list;
  list.push_back(area_above_of(building.roof_irradiation, "roof_area_above_m2"));
  list.push_back(area_above_of(building.wall_irradiation, "wall_area_above_m2"));
  return list;
}

}  // namespace farlod
