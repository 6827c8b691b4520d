// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "farlod/morphology.hpp"

namespace farlod {
namespace {

/// A column, and how a cell has its value.
struct MorphologyColumn {
  const char *name, *unit, *definition;
  std::optional<double> (*value)(const UrbanForm& cell);
};

std::optional<double> if_built(const UrbanForm& c, double value) {
  return c.amounts.buildings > 0 ? std::optional(value) : std::nullopt;
}

std::optional<double> length_of(const std::optional<Roughness>& r) { return r ? std::optional(r->length_m) : std::nullopt; }
std::optional<double> displacement_of(const std::optional<Roughness>& r) {
  return r ? std::optional(r->displacement_m) : std::nullopt;
}

std::optional<double> crown_height_of(const std::optional<CellVegetation>& v) {
  return v && v->count > 0 ? std::optional(v->height_mean_m) : std::nullopt;
}

using Morphology = const UrbanForm&;

constexpr MorphologyColumn before_winds[] = {
    {"area_m2", "m2", "plan area of the cell", [](Morphology c) { return std::optional(c.amounts.plan_area_m2); }},
    {"buildings", "1", "buildings that are seen from above",
     [](Morphology c) { return std::optional(static_cast<double>(c.amounts.buildings)); }},
    {"building_plan_area_m2", "m2", "plan area of buildings seen from above, overlaps once",
     [](Morphology c) { return std::optional(c.amounts.building_plan_area_m2); }},
    {"roof_area_m2", "m2", "area of roofs seen from above, along their slopes",
     [](Morphology c) { return std::optional(c.amounts.roof_area_m2); }},
    {"wall_area_m2", "m2", "area of walls above the ground, without party walls",
     [](Morphology c) { return std::optional(c.amounts.wall_area_m2); }},
    {"building_volume_m3", "m3", "volume between ground and roofs seen from above",
     [](Morphology c) { return std::optional(c.amounts.volume_m3); }},
    {"lambda_p", "1", "plan area fraction", [](Morphology c) { return std::optional(c.lambda_p()); }},
    {"wall_to_plan", "1", "wall area over plan area", [](Morphology c) { return std::optional(c.wall_to_plan()); }},
    {"complete_aspect_ratio", "1", "area of walls, roofs and open ground over plan area",
     [](Morphology c) { return std::optional(c.complete_aspect_ratio()); }},
    {"height_to_width", "1", "half the wall area over the plan area without buildings",
     [](Morphology c) { return c.height_to_width(); }},
    {"building_height_mean_m", "m", "mean height of the buildings, each once",
     [](Morphology c) { return if_built(c, c.amounts.building_height_mean_m); }},
    {"building_height_std_m", "m", "standard deviation of the heights of the buildings, each once",
     [](Morphology c) { return if_built(c, c.amounts.building_height_std_m); }},
    {"height_mean_m", "m", "mean height over the building plan area", [](Morphology c) { return c.height_mean_m(); }},
    {"height_std_m", "m", "standard deviation of the height over the building plan area",
     [](Morphology c) { return c.height_std_m(); }},
    {"height_max_m", "m", "largest height", [](Morphology c) { return if_built(c, c.amounts.height_max_m); }},
    {"z0_macdonald_m", "m", "roughness length by Macdonald et al. (1998)",
     [](Morphology c) { return length_of(c.roughness_macdonald()); }},
    {"zd_macdonald_m", "m", "displacement height by Macdonald et al. (1998)",
     [](Morphology c) { return displacement_of(c.roughness_macdonald()); }},
    {"z0_kanda_m", "m", "roughness length by Kanda et al. (2013)", [](Morphology c) { return length_of(c.roughness_kanda()); }},
    {"zd_kanda_m", "m", "displacement height by Kanda et al. (2013)",
     [](Morphology c) { return displacement_of(c.roughness_kanda()); }},
    {"vegetation_fraction", "1", "share of the plan area below crowns", [](Morphology c) { return c.vegetation_fraction(); }},
    {"crowns", "1", "crowns of trees whose axes stand in the cell",
     [](Morphology c) { return c.vegetation ? std::optional(static_cast<double>(c.vegetation->count)) : std::nullopt; }},
    {"crown_height_mean_m", "m", "mean height of the tops of those crowns above the ground",
     [](Morphology c) { return crown_height_of(c.vegetation); }},
    {"svf_ground", "1", "mean sky view factor of the ground between buildings", [](Morphology c) { return c.sky.ground; }},
    {"svf_walls", "1", "mean sky view factor of walls, by area", [](Morphology c) { return c.sky.walls; }},
    {"svf_roofs", "1", "mean sky view factor of roofs, by area", [](Morphology c) { return c.sky.roofs; }},
    {"lambda_f", "1", "frontal area density, mean of 16 wind directions",
     [](Morphology c) { return std::optional(c.lambda_f_mean()); }},
};

/// A column for each wind, named by the whole degrees that it comes from, rounded down: lambda_f_022 is 22.5°.
ColumnDescription wind_column(std::size_t wind) {
  static_assert(720 % wind_directions == 0);
  const std::size_t half_degrees = 720 / wind_directions * wind;
  const std::string whole = std::to_string(half_degrees / 2), half = half_degrees % 2 == 0 ? "" : ".5";
  return {"lambda_f_" + std::string(3 - whole.size(), '0') + whole, "1",
          "frontal area density for wind from " + whole + half + "°, clockwise from true north"};
}

/// "05", or "70".
std::string metres_text(std::size_t border) {
  const std::size_t metres = border * static_cast<std::size_t>(height_bin_m);
  return (metres < 10 ? "0" : "") + std::to_string(metres);
}

/// A column for each bin, named by its borders in metres: height_share_05_10.
ColumnDescription height_column(std::size_t bin) {
  const std::string low = metres_text(bin), share = "share of the building plan area with a height of ";
  if (bin + 1 == height_bins) return {"height_share_" + low, "1", share + low + " m and more"};
  const std::string high = metres_text(bin + 1);
  return {"height_share_" + low + "_" + high, "1", share + low + " m to " + high + " m"};
}

}  // namespace

std::vector<ColumnDescription> morphology_columns() {
  std::vector<ColumnDescription> columns;
  for (const MorphologyColumn& c : before_winds) columns.push_back({c.name, c.unit, c.definition});
  for (std::size_t k = 0; k < wind_directions; ++k) columns.push_back(wind_column(k));
  for (std::size_t k = 0; k < height_bins; ++k) columns.push_back(height_column(k));
  return columns;
}

std::vector<std::optional<double>> morphology_values(const UrbanForm& form) {
  std::vector<std::optional<double>> values;
  if (!(form.amounts.plan_area_m2 > 0.0)) {
    values.resize(morphology_columns().size());
    return values;
  }
  for (const MorphologyColumn& c : before_winds) values.push_back(c.value(form));
  for (std::size_t k = 0; k < wind_directions; ++k) values.emplace_back(form.lambda_f(k));
  for (std::size_t k = 0; k < height_bins; ++k) values.push_back(form.height_share(k));
  return values;
}

}  // namespace farlod
