// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/morphology_table.hpp"

#include <fmt/core.h>

#include <cmath>
#include <ostream>
#include <string>

#include "results/atomic_file.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

/// A column, and how a cell has its value.
struct MorphologyColumn {
  const char *name, *unit, *definition;
  std::optional<double> (*value)(const CellMorphology& cell);
};

std::optional<double> if_built(const CellMorphology& c, double value) {
  return c.amounts.buildings > 0 ? std::optional(value) : std::nullopt;
}

std::optional<double> length_of(const std::optional<Roughness>& r) { return r ? std::optional(r->length_m) : std::nullopt; }
std::optional<double> displacement_of(const std::optional<Roughness>& r) {
  return r ? std::optional(r->displacement_m) : std::nullopt;
}

using Morphology = const CellMorphology&;

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
    {"lambda_f", "1", "frontal area density, mean of 16 wind directions",
     [](Morphology c) { return std::optional(c.lambda_f_mean()); }},
};

/// Where the wind comes from, in whole degrees, rounded down: lambda_f_022 is 22.5°.
double wind_deg(std::size_t wind) { return 360.0 * static_cast<double>(wind) / static_cast<double>(wind_directions); }

double rounded(double value, const std::string& unit) {
  const double parts = unit == "1" ? 1e6 : 1e3;
  return std::round(value * parts) / parts;
}

Point2d centre_of(const CellMorphology& cell) { return 0.5 * (cell.corners_projected[0] + cell.corners_projected[2]); }

}  // namespace

std::vector<ColumnDescription> morphology_columns() {
  std::vector<ColumnDescription> columns;
  for (const MorphologyColumn& c : before_winds) columns.push_back({c.name, c.unit, c.definition});
  for (std::size_t k = 0; k < wind_directions; ++k)
    columns.push_back({fmt::format("lambda_f_{:03.0f}", std::floor(wind_deg(k))), "1",
                       fmt::format("frontal area density for wind from {:g}°, clockwise from true north", wind_deg(k))});
  return columns;
}

std::vector<std::optional<double>> morphology_values(const CellMorphology& cell) {
  std::vector<std::optional<double>> values;
  for (const MorphologyColumn& c : before_winds) {
    const auto value = c.value(cell);
    values.push_back(value ? std::optional(rounded(*value, c.unit)) : std::nullopt);
  }
  for (std::size_t k = 0; k < wind_directions; ++k) values.emplace_back(rounded(cell.lambda_f(k), "1"));
  return values;
}

void write_morphology_csv(std::span<const CellMorphology> cells, const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& out) {
    CsvText text;
    text.fields({"i", "j", "x_m", "y_m"});
    for (const ColumnDescription& column : morphology_columns()) text.field(column.name);
    text.end_row();
    for (const CellMorphology& cell : cells) {
      text.field(fmt::format("{}", cell.cell.i)).field(fmt::format("{}", cell.cell.j));
      text.millimetres(centre_of(cell).x).millimetres(centre_of(cell).y);
      for (const auto& value : morphology_values(cell)) text.field(value ? fmt::format("{}", *value) : "");
      text.end_row();
    }
    out << text.bytes();
  });
}

void write_morphology_as_features(std::span<const CellMorphology> cells, FeatureWriter& writer) {
  FeatureLayer layer{"cells", "Urban form of the cells of the grid", {{"i", FieldType::whole}, {"j", FieldType::whole}}};
  for (const char* const name : {"x_m", "y_m"}) layer.fields.push_back({name, FieldType::real});
  for (const ColumnDescription& column : morphology_columns()) layer.fields.push_back({column.name, FieldType::real});
  layer.geometry = LayerGeometry::areas;
  writer.begin(layer);
  for (const CellMorphology& cell : cells) {
    const Point2d centre = centre_of(cell);
    FeatureRow row{centre, {}, {std::int64_t{cell.cell.i}, std::int64_t{cell.cell.j}}};
    for (const double x_or_y : {centre.x, centre.y}) row.values.emplace_back(rounded(x_or_y, "m"));
    for (const auto& value : morphology_values(cell)) row.values.push_back(value ? FieldValue(*value) : FieldValue());
    std::vector<Point3d>& shell = row.polygons.emplace_back().shell;
    for (const Point2d corner : cell.corners_projected) shell.push_back({corner.x, corner.y, 0.0});
    writer.add(row);
  }
}

}  // namespace farlod
