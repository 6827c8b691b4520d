// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_features.hpp"

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/expects.hpp"
#include "results/table/area_columns.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

/// The double that is nearest to a decimal of so many digits: what a reader of the CSV file has.
FieldValue rounded(double value, double parts) { return std::round(value * parts) / parts; }
FieldValue millimetres(double value) { return rounded(value, 1e3); }
FieldValue share(double value) { return rounded(value, 1e6); }
FieldValue millimetres(const std::optional<double>& value) { return value ? millimetres(*value) : FieldValue(); }
FieldValue share(const std::optional<double>& value) { return value ? share(*value) : FieldValue(); }
FieldValue whole(std::uint64_t value) { return static_cast<std::int64_t>(value); }
FieldValue number(float value) { return std::isnan(value) ? FieldValue() : FieldValue(static_cast<double>(value)); }
FieldValue number(const AreaColumn& column) {
  if (column.form == NumberForm::shortest || std::isnan(column.value)) return number(static_cast<float>(column.value));
  return millimetres(column.value);
}

void add_fields(FeatureLayer& layer, FieldType type, std::initializer_list<std::string> names) {
  for (const std::string& name : names) layer.fields.push_back({name, type});
}

void add_answer_fields(FeatureLayer& layer, const AnswerColumns& columns) {
  for (const std::string& name : names_of(columns)) layer.fields.push_back({name, FieldType::real});
}

template <class Row>
void add_answers(const Row& row, const AnswerColumns& columns, FeatureRow& feature) {
  FARLOD_EXPECTS(row.further.empty() || row.further.size() == columns.further.size());
  feature.values.push_back(share(row.svf));
  if (columns.bounds == BoundsColumns::yes) feature.values.insert(feature.values.end(), {share(row.low), share(row.high)});
  for (std::size_t k = 0; k < columns.further.size(); ++k) feature.values.push_back(number(further_value(row.further, k)));
}

template <class Number>
bool is_whole_text(std::string_view text, Number& number) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

/// Whether a number has a zero before its first digit, as keys and post codes have.
bool has_leading_zero(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.size() > 1 && text[0] == '0' && text[1] >= '0' && text[1] <= '9';
}

FieldType type_of(std::string_view text) {
  std::int64_t whole_number = 0;
  double real = 0.0;
  constexpr std::size_t digits_of_double = 17;
  if (has_leading_zero(text)) return FieldType::text;
  if (is_whole_text(text, whole_number)) return FieldType::whole;
  // A sign, a point and an exponent besides
  const bool is_short = text.size() <= digits_of_double + 7;
  return is_short && is_whole_text(text, real) && std::isfinite(real) ? FieldType::real : FieldType::text;
}

/// None without a package.
std::unique_ptr<SurfaceShapes> shapes_of(const TableFrame& frame, std::span<const BuildingMean> buildings,
                                         const std::filesystem::path& path) {
  return frame.package == nullptr ? nullptr : std::make_unique<SurfaceShapes>(*frame.package, buildings, path);
}

FeatureLayer layer_of_points(const PointRows& rows, const TableFrame& frame) {
  FeatureLayer layer{"points", "Receivers and their sky view factors", {{"id", FieldType::text}}};
  for (std::size_t k = 0; rows.attributes != nullptr && k < rows.attributes->names().size(); ++k)
    layer.fields.push_back({rows.attributes->names()[k], type_of_column(*rows.attributes, k, rows.count)});
  add_fields(layer, FieldType::real, {"x_m", "y_m", "z_m", "height_above_ground_m"});
  if (rows.normals) add_fields(layer, FieldType::real, {"azimuth_deg", "tilt_deg"});
  add_answer_fields(layer, frame.columns);
  return layer;
}

}  // namespace

FieldType type_of_column(const Attributes& attributes, std::size_t column, std::size_t rows) {
  std::optional<FieldType> type;
  for (std::size_t row = 0; row < rows && type != FieldType::text; ++row) {
    const std::string_view text = attributes.value(row, column);
    if (text.empty()) continue;
    const FieldType one = type_of(text);
    // Whole numbers and others are all numbers
    type = !type || one == FieldType::text ? one : *type == one ? one : FieldType::real;
  }
  return type.value_or(FieldType::text);
}

FieldValue attribute_value(std::string_view text, FieldType type) {
  if (text.empty()) return {};
  std::int64_t whole_number = 0;
  double real = 0.0;
  if (type == FieldType::whole && is_whole_text(text, whole_number)) return whole_number;
  if (type == FieldType::real && is_whole_text(text, real)) return real;
  return text;
}

void write_points_as_features(const PointRows& rows, const TableFrame& frame, FeatureWriter& writer) {
  const FeatureLayer layer = layer_of_points(rows, frame);
  const std::size_t attributes = rows.attributes == nullptr ? 0 : rows.attributes->names().size();
  writer.begin(layer);
  FeatureRow feature;
  for (std::size_t n = 0; n < rows.count; ++n) {
    const PointRow row = rows.row(n);
    feature.p_projected = row.p_projected;
    feature.height_m = row.height_m;
    feature.values = {std::string_view(row.id)};
    for (std::size_t k = 0; k < attributes; ++k)
      feature.values.push_back(attribute_value(rows.attributes->value(n, k), layer.fields[k + 1].type));
    feature.values.insert(feature.values.end(), {row.has_place() ? millimetres(row.p_projected.x) : FieldValue(),
                                                 row.has_place() ? millimetres(row.p_projected.y) : FieldValue(),
                                                 millimetres(row.height_m), millimetres(row.above_ground_m)});
    if (rows.normals) feature.values.insert(feature.values.end(), {millimetres(row.azimuth_deg), millimetres(row.tilt_deg)});
    add_answers(row, frame.columns, feature);
    writer.add(feature);
  }
}

void write_receivers_as_features(SurfaceSpool& receivers, const TableFrame& frame, FeatureWriter& writer) {
  FeatureLayer layer{"receivers",
                     "Receivers on surfaces of buildings, and their sky view factors",
                     {{"building", FieldType::text}, {"surface", FieldType::whole}, {"kind", FieldType::text}}};
  add_fields(layer, FieldType::real, {"x_m", "y_m", "z_m", "azimuth_deg", "tilt_deg", "area_m2"});
  add_answer_fields(layer, frame.columns);
  writer.begin(layer);
  FeatureRow feature;
  receivers.for_each([&](const SurfacePoint& r) {
    feature.p_projected = {r.p_projected.x, r.p_projected.y};
    feature.height_m = r.p_projected.z;
    feature.values = {std::string_view(r.building),
                      whole(r.surface),
                      word_for(surface_kind_words, r.kind),
                      millimetres(r.p_projected.x),
                      millimetres(r.p_projected.y),
                      millimetres(r.p_projected.z),
                      millimetres(r.azimuth.degrees()),
                      millimetres(r.tilt.degrees()),
                      millimetres(r.area_m2)};
    add_answers(r, frame.columns, feature);
    writer.add(feature);
  });
}

void write_surfaces_as_features(std::span<const SurfaceMean> rows, const TableFrame& frame, SurfaceShapes* shapes,
                                FeatureWriter& writer) {
  FeatureLayer layer{"surfaces",
                     "Surfaces, with averages of their receivers",
                     {{"building", FieldType::text}, {"surface", FieldType::whole}, {"kind", FieldType::text}},
                     shapes == nullptr ? LayerGeometry::none : LayerGeometry::polygons};
  const std::string& quantity = frame.columns.quantity;
  add_fields(layer, FieldType::real, {"azimuth_deg", "tilt_deg", "area_m2"});
  add_fields(layer, FieldType::whole, {"receivers", "nodata"});
  add_fields(layer, FieldType::real, {quantity + "_mean", quantity + "_min", quantity + "_max", "covered_area_m2"});
  for (const AreaColumn& column : area_columns_of(SurfaceMean{}, frame.columns))
    add_fields(layer, FieldType::real, {column.name});
  const bool with_ids = have_ids(rows);
  if (with_ids) add_fields(layer, FieldType::text, {"surface_id"});
  writer.begin(layer);
  for (const SurfaceMean& r : rows) {
    FeatureRow feature{
        {},
        {},
        {std::string_view(r.building), whole(r.surface), word_for(surface_kind_words, r.kind), millimetres(r.azimuth.degrees()),
         millimetres(r.tilt.degrees()), millimetres(r.area_m2), whole(r.receivers), whole(r.nodata), share(r.svf_mean),
         share(r.svf_min), share(r.svf_max), millimetres(r.covered_area_m2)}};
    for (const AreaColumn& column : area_columns_of(r, frame.columns)) feature.values.push_back(number(column));
    if (with_ids) feature.values.push_back(r.id.empty() ? FieldValue() : std::string_view(r.id));
    if (shapes != nullptr) feature.polygons = shapes->of(r.building, r.surface);
    writer.add(feature);
  }
}

void write_buildings_as_features(std::span<const BuildingMean> rows, const TableFrame& frame, FeatureWriter& writer) {
  FeatureLayer layer{
      "buildings", "Buildings, with averages of their receivers", {{"building", FieldType::text}}, LayerGeometry::none};
  const std::string& quantity = frame.columns.quantity;
  add_fields(layer, FieldType::real, {"roof_area_m2", "wall_area_m2"});
  add_fields(layer, FieldType::whole, {"receivers", "nodata"});
  add_fields(layer, FieldType::real, {quantity + "_roofs", quantity + "_walls", "covered_roof_area_m2", "covered_wall_area_m2"});
  for (const AreaColumn& column : area_columns_of(BuildingMean{}, frame.columns))
    add_fields(layer, FieldType::real, {column.name});
  writer.begin(layer);
  for (const BuildingMean& r : rows) {
    const BuildingAreas areas = areas_of(r);
    FeatureRow feature{{},
                       {},
                       {std::string_view(r.building), millimetres(areas.roofs_m2), millimetres(areas.walls_m2),
                        whole(r.receivers), whole(r.nodata), share(r.svf_roofs), share(r.svf_walls),
                        millimetres(areas.covered_roofs_m2), millimetres(areas.covered_walls_m2)}};
    for (const AreaColumn& column : area_columns_of(r, frame.columns)) feature.values.push_back(number(column));
    writer.add(feature);
  }
}

std::vector<std::filesystem::path> SurfaceTablesInLayers::commit(std::span<const SurfaceMean> surfaces,
                                                                 std::span<const BuildingMean> buildings) {
  const std::unique_ptr<SurfaceShapes> shapes = shapes_of(frame_, buildings, path_);
  write_receivers_as_features(receivers_, frame_, *writer_);
  write_surfaces_as_features(surfaces, frame_, shapes.get(), *writer_);
  write_buildings_as_features(buildings, frame_, *writer_);
  writer_->commit();
  return {path_};
}

std::vector<std::filesystem::path> SurfaceTablesInFiles::commit(std::span<const SurfaceMean> surfaces,
                                                                std::span<const BuildingMean> buildings) {
  const std::filesystem::path csv = std::filesystem::path(path_).replace_extension(".csv");
  const std::unique_ptr<SurfaceShapes> shapes = shapes_of(frame_, buildings, path_);
  std::vector<std::filesystem::path> files{path_, table_beside(shapes ? path_ : csv, ".surfaces"),
                                           table_beside(csv, ".buildings")};
  if (shapes) {
    const std::unique_ptr<FeatureWriter> writer = make_writer_(frame_, files[1]);
    write_surfaces_as_features(surfaces, frame_, shapes.get(), *writer);
    writer->commit();
  } else {
    write_surfaces_csv(surfaces, frame_.columns, files[1]);
  }
  write_buildings_csv(buildings, frame_.columns, files[2]);
  // The file of -o appears last
  const std::unique_ptr<FeatureWriter> writer = make_writer_(frame_, path_);
  write_receivers_as_features(receivers_, frame_, *writer);
  writer->commit();
  return files;
}

std::vector<std::filesystem::path> SurfaceTablesBesideCsv::commit(std::span<const SurfaceMean> surfaces,
                                                                  std::span<const BuildingMean> buildings) {
  const std::filesystem::path csv = std::filesystem::path(path_).replace_extension(".csv");
  std::vector<std::filesystem::path> files{path_, table_beside(csv, ".surfaces"), table_beside(csv, ".buildings")};
  write_surfaces_csv(surfaces, frame_.columns, files[1]);
  write_buildings_csv(buildings, frame_.columns, files[2]);
  write_(receivers_);  // the file of -o appears last
  return files;
}

}  // namespace farlod
