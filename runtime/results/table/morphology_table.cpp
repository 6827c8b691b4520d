// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/morphology_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/expects.hpp"
#include "base/lower_case.hpp"
#include "results/atomic_file.hpp"
#include "results/table/sky_features.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

double rounded(double value, const std::string& unit) {
  const double parts = unit == "1" ? 1e6 : 1e3;
  return std::round(value * parts) / parts;
}

/// All values of a row, as tables have them.
std::vector<std::optional<double>> rounded_values(const UrbanForm& form, const std::vector<ColumnDescription>& columns) {
  std::vector<std::optional<double>> values = morphology_values(form);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (values[n]) values[n] = rounded(*values[n], columns[n].unit);
  return values;
}

std::string csv_text_of(const FieldValue& value) {
  if (const auto* text = std::get_if<std::string_view>(&value)) return std::string(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  return {};
}

template <class Corners>
std::vector<Point3d> level_ring(const Corners& corners) {
  std::vector<Point3d> ring;
  for (const Point2d corner : corners) ring.push_back({corner.x, corner.y, 0.0});
  return ring;
}

/// Sums over the triangles between a corner of the whole and the edges of rings; holes, which turn the other way, count less.
class CentreOfMass {
 public:
  explicit CentreOfMass(Point2d origin) : origin_(origin) {}
  void add(const std::vector<Point2d>& ring) {
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Point2d a = ring[n] - origin_, b = ring[(n + 1) % ring.size()] - origin_;
      const double doubled = a.x * b.y - a.y * b.x;
      doubled_area_ += doubled;
      moment_ = moment_ + doubled * (a + b);
    }
  }
  /// A corner, where there is no area.
  [[nodiscard]] Point2d centre() const {
    return doubled_area_ != 0.0 ? origin_ + (1.0 / (3.0 * doubled_area_)) * moment_ : origin_;
  }

 private:
  Point2d origin_, moment_{0.0, 0.0};
  double doubled_area_ = 0.0;
};

Point2d centre_of(const std::vector<ZonePolygon>& zone) {
  CentreOfMass sums(zone.front().shell.empty() ? Point2d{0.0, 0.0} : zone.front().shell.front());
  for (const ZonePolygon& polygon : zone) {
    sums.add(polygon.shell);
    for (const auto& hole : polygon.holes) sums.add(hole);
  }
  return sums.centre();
}

std::vector<SurfacePolygon> areas_of_zone(const std::vector<ZonePolygon>& zone) {
  std::vector<SurfacePolygon> areas;
  for (const ZonePolygon& polygon : zone) {
    SurfacePolygon& area = areas.emplace_back();
    area.shell = level_ring(polygon.shell);
    for (const auto& hole : polygon.holes) area.holes.push_back(level_ring(hole));
  }
  return areas;
}

/// The columns of all tables of zones, and the fields of these.
std::vector<FeatureField> fields_of_zones(const RequestedZones& zones) {
  std::vector<FeatureField> fields{{"zone", FieldType::whole}};
  std::vector<std::string> taken{"zone", "x_m", "y_m"};
  for (const ColumnDescription& column : morphology_columns()) taken.push_back(column.name);
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(taken, [&](const std::string& one) { return lower_case(one) == lower_case(name); });
  };
  for (std::size_t k = 0; k < zones.attributes.names().size(); ++k) {
    std::string name = zones.attributes.names()[k];
    while (is_taken(name)) name += "_input";
    taken.push_back(name);
    fields.push_back({std::move(name), type_of_column(zones.attributes, k, zones.zones.size())});
  }
  return fields;
}

}  // namespace

FormTable table_of_cells(std::span<const CellMorphology> cells) {
  FormTable table{"cells", "Urban form of the cells of the grid", {{"i", FieldType::whole}, {"j", FieldType::whole}}};
  for (const CellMorphology& cell : cells)
    table.rows.push_back({{std::int64_t{cell.cell.i}, std::int64_t{cell.cell.j}},
                          0.5 * (cell.corners_projected[0] + cell.corners_projected[2]),
                          {{level_ring(cell.corners_projected), {}}},
                          static_cast<const UrbanForm&>(cell)});
  return table;
}

FormTable table_of_zones(const RequestedZones& zones, std::span<const UrbanForm> forms) {
  FARLOD_EXPECTS(zones.zones.size() == forms.size());
  FormTable table{"zones", "Urban form of polygons", fields_of_zones(zones), LayerGeometry::multiple_areas};
  for (std::size_t n = 0; n < forms.size(); ++n) {
    FormRow row{{static_cast<std::int64_t>(n + 1)}, centre_of(zones.zones[n]), areas_of_zone(zones.zones[n]), forms[n]};
    for (std::size_t k = 1; k < table.identity.size(); ++k)
      row.identity.push_back(attribute_value(zones.attributes.value(n, k - 1), table.identity[k].type));
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_morphology_csv(const FormTable& table, const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& out) {
    CsvText text;
    for (const FeatureField& field : table.identity) text.field(field.name);
    text.fields({"x_m", "y_m"});
    const std::vector<ColumnDescription> described = morphology_columns();
    for (const ColumnDescription& column : described) text.field(column.name);
    text.end_row();
    for (const FormRow& row : table.rows) {
      for (const FieldValue& value : row.identity) text.field(csv_text_of(value));
      text.millimetres(row.centre.x).millimetres(row.centre.y);
      for (const auto& value : rounded_values(row.form, described)) text.field(value ? fmt::format("{}", *value) : "");
      text.end_row();
    }
    out << text.bytes();
  });
}

void write_morphology_as_features(const FormTable& table, FeatureWriter& writer) {
  FeatureLayer layer{table.name, table.description, table.identity, table.geometry};
  for (const char* const name : {"x_m", "y_m"}) layer.fields.push_back({name, FieldType::real});
  const std::vector<ColumnDescription> described = morphology_columns();
  for (const ColumnDescription& column : described) layer.fields.push_back({column.name, FieldType::real});
  writer.begin(layer);
  for (const FormRow& row : table.rows) {
    FeatureRow feature{row.centre, {}, row.identity, row.areas};
    for (const double x_or_y : {row.centre.x, row.centre.y}) feature.values.emplace_back(rounded(x_or_y, "m"));
    for (const auto& value : rounded_values(row.form, described))
      feature.values.push_back(value ? FieldValue(*value) : FieldValue());
    writer.add(feature);
  }
}

}  // namespace farlod
