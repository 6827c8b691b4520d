// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/morphology_table.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "results/atomic_file.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

double rounded(double value, const std::string& unit) {
  const double parts = unit == "1" ? 1e6 : 1e3;
  return std::round(value * parts) / parts;
}

/// All values of a cell, as tables have them.
std::vector<std::optional<double>> rounded_values(const CellMorphology& cell, const std::vector<ColumnDescription>& columns) {
  std::vector<std::optional<double>> values = morphology_values(cell);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (values[n]) values[n] = rounded(*values[n], columns[n].unit);
  return values;
}

Point2d centre_of(const CellMorphology& cell) { return 0.5 * (cell.corners_projected[0] + cell.corners_projected[2]); }

}  // namespace

void write_morphology_csv(std::span<const CellMorphology> cells, const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& out) {
    CsvText text;
    text.fields({"i", "j", "x_m", "y_m"});
    const std::vector<ColumnDescription> described = morphology_columns();
    for (const ColumnDescription& column : described) text.field(column.name);
    text.end_row();
    for (const CellMorphology& cell : cells) {
      text.field(fmt::format("{}", cell.cell.i)).field(fmt::format("{}", cell.cell.j));
      text.millimetres(centre_of(cell).x).millimetres(centre_of(cell).y);
      for (const auto& value : rounded_values(cell, described)) text.field(value ? fmt::format("{}", *value) : "");
      text.end_row();
    }
    out << text.bytes();
  });
}

void write_morphology_as_features(std::span<const CellMorphology> cells, FeatureWriter& writer) {
  FeatureLayer layer{"cells", "Urban form of the cells of the grid", {{"i", FieldType::whole}, {"j", FieldType::whole}}};
  for (const char* const name : {"x_m", "y_m"}) layer.fields.push_back({name, FieldType::real});
  const std::vector<ColumnDescription> described = morphology_columns();
  for (const ColumnDescription& column : described) layer.fields.push_back({column.name, FieldType::real});
  layer.geometry = LayerGeometry::areas;
  writer.begin(layer);
  for (const CellMorphology& cell : cells) {
    const Point2d centre = centre_of(cell);
    FeatureRow row{centre, {}, {std::int64_t{cell.cell.i}, std::int64_t{cell.cell.j}}};
    for (const double x_or_y : {centre.x, centre.y}) row.values.emplace_back(rounded(x_or_y, "m"));
    for (const auto& value : rounded_values(cell, described)) row.values.push_back(value ? FieldValue(*value) : FieldValue());
    std::vector<Point3d>& shell = row.polygons.emplace_back().shell;
    for (const Point2d corner : cell.corners_projected) shell.push_back({corner.x, corner.y, 0.0});
    writer.add(row);
  }
}

}  // namespace farlod
