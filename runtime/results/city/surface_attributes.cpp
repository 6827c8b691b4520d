// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/surface_attributes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "results/decimal.hpp"

namespace farlod {
namespace {

void add_svf(CityAttributes& attributes, const std::string& name, std::optional<double> value) {
  if (value) attributes.emplace_back(name, svf_decimal(*value));
}

void add_area(CityAttributes& attributes, const std::string& name, double area_m2) {
  std::string text;
  append_millimetres(text, area_m2);
  attributes.emplace_back(name, std::move(text));
}

void take_extreme(std::optional<double>& extreme, std::optional<double> value, bool (*is_better)(double, double)) {
  if (value && (!extreme || is_better(*value, *extreme))) extreme = value;
}

/// Adds the values of `next`; means are sums until `divide` has divided them.
void add(SurfaceMean& sum, const SurfaceMean& next) {
  sum.area_m2 += next.area_m2;
  sum.covered_area_m2 += next.covered_area_m2;
  take_extreme(sum.svf_min, next.svf_min, [](double a, double b) { return a < b; });
  take_extreme(sum.svf_max, next.svf_max, [](double a, double b) { return a > b; });
  if (next.svf_mean) sum.svf_mean = sum.svf_mean.value_or(0.0) + next.area_m2 * *next.svf_mean;
  if (sum.further_mean.empty()) sum.further_mean.resize(next.further_mean.size());
  for (std::size_t k = 0; k < next.further_mean.size(); ++k) sum.further_mean[k] += next.area_m2 * next.further_mean[k];
}

void divide(SurfaceMean& sum) {
  if (sum.svf_mean) *sum.svf_mean /= sum.area_m2;
  for (double& mean : sum.further_mean) mean /= sum.area_m2;
}

SurfaceMean merged(std::span<const SurfaceMean* const> surfaces) {
  // The mean of one is its own to the last digit
  if (surfaces.size() == 1) return *surfaces.front();
  SurfaceMean sum;
  for (const SurfaceMean* surface : surfaces) add(sum, *surface);
  divide(sum);
  return sum;
}

}  // namespace

std::vector<std::string> attribute_names_of_surfaces(const AnswerColumns& columns) {
  const std::string& q = columns.quantity;
  std::vector<std::string> names{q + "_mean", q + "_min", q + "_max", "svf_area_m2", "covered_area_m2"};
  for (const ColumnDescription& column : columns.further) names.push_back(column.name + "_mean");
  return names;
}

std::vector<std::string> attribute_names_of_buildings(const AnswerColumns& columns) {
  return {columns.quantity + "_roofs", columns.quantity + "_walls", "roof_area_m2", "wall_area_m2",
          "covered_roof_area_m2",      "covered_wall_area_m2"};
}

CityAttributes attributes_of(std::span<const SurfaceMean* const> surfaces, const AnswerColumns& columns) {
  const SurfaceMean mean = merged(surfaces);
  const std::vector<std::string> names = attribute_names_of_surfaces(columns);
  CityAttributes attributes;
  add_svf(attributes, names[0], mean.svf_mean);
  add_svf(attributes, names[1], mean.svf_min);
  add_svf(attributes, names[2], mean.svf_max);
  add_area(attributes, names[3], mean.area_m2);
  add_area(attributes, names[4], mean.covered_area_m2);
  for (std::size_t k = 0; k < columns.further.size(); ++k)
    if (const float value = further_value(mean.further_mean, k); !std::isnan(value))
      attributes.emplace_back(names[5 + k], shortest_decimal(value));
  return attributes;
}

CityAttributes attributes_of(const BuildingMean& building, const AnswerColumns& columns) {
  const std::vector<std::string> names = attribute_names_of_buildings(columns);
  CityAttributes attributes;
  add_svf(attributes, names[0], building.svf_roofs);
  add_svf(attributes, names[1], building.svf_walls);
  const bool has_roofs = building.roof_area_m2 + building.covered_roof_area_m2 > 0.0;
  const bool has_walls = building.wall_area_m2 + building.covered_wall_area_m2 > 0.0;
  if (has_roofs) add_area(attributes, names[2], building.roof_area_m2);
  if (has_walls) add_area(attributes, names[3], building.wall_area_m2);
  if (has_roofs) add_area(attributes, names[4], building.covered_roof_area_m2);
  if (has_walls) add_area(attributes, names[5], building.covered_wall_area_m2);
  return attributes;
}

BuildingMean mean_of(std::span<const SurfaceMean* const> surfaces) {
  SurfaceMean roofs, walls;
  for (const SurfaceMean* surface : surfaces) add(surface->kind == SurfaceKind::roof ? roofs : walls, *surface);
  divide(roofs);
  divide(walls);
  BuildingMean mean;
  mean.roof_area_m2 = roofs.area_m2;
  mean.wall_area_m2 = walls.area_m2;
  mean.covered_roof_area_m2 = roofs.covered_area_m2;
  mean.covered_wall_area_m2 = walls.covered_area_m2;
  mean.svf_roofs = roofs.svf_mean;
  mean.svf_walls = walls.svf_mean;
  return mean;
}

}  // namespace farlod
