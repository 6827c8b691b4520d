// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_table_csv.hpp"

#include <cmath>
#include <ostream>
#include <utility>

#include "base/expects.hpp"
#include "results/atomic_file.hpp"
#include "results/table/area_columns.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

/// Number of rows that are kept as text before they are written.
constexpr std::size_t rows_at_once = 1024;

/// Writes a header and `count` rows; `add_row(n, text)` adds the n-th one.
template <class AddRow>
void write_table(const std::filesystem::path& path, CsvText header, std::size_t count, const AddRow& add_row) {
  write_atomically(path, [&](std::ostream& out) {
    CsvText text = std::move(header);
    for (std::size_t n = 0; n < count; ++n) {
      add_row(n, text);
      if (n % rows_at_once == 0) out << std::exchange(text, {}).bytes();
    }
    out << text.bytes();
  });
}

/// The columns of a table of receivers: identity and place, then the answers.
CsvText receiver_header(std::initializer_list<std::string_view> identity, const AnswerColumns& columns) {
  CsvText text;
  text.fields(identity);
  for (const std::string& name : names_of(columns)) text.field(name);
  text.end_row();
  return text;
}

template <class Row>
void add_answer(const Row& row, const AnswerColumns& columns, CsvText& text) {
  FARLOD_EXPECTS(row.further.empty() || row.further.size() == columns.further.size());
  text.svf(row.svf);
  if (columns.bounds == BoundsColumns::yes) text.svf(row.low).svf(row.high);
  for (std::size_t k = 0; k < columns.further.size(); ++k) text.number(further_value(row.further, k));
  text.end_row();
}

void add_point(const PointRow& r, CsvText& text) {
  const auto where_placed = [&r](double value) { return r.has_place() ? std::optional(value) : std::nullopt; };
  text.millimetres(where_placed(r.p_projected.x)).millimetres(where_placed(r.p_projected.y));
  text.millimetres(r.height_m).millimetres(r.above_ground_m);
}

CsvText point_header(const PointRows& rows, const AnswerColumns& columns) {
  const std::vector<std::string> own = own_columns_of_points(rows.normals, columns);
  CsvText text;
  text.field(own.front());
  if (rows.attributes != nullptr)
    for (const std::string& name : rows.attributes->names()) text.field(name);
  for (const std::string& name : std::span(own).subspan(1)) text.field(name);
  text.end_row();
  return text;
}

// A thousandth of a degree is 1.7 cm over a kilometre
void add_surface_point(const SurfacePoint& r, CsvText& text) {
  text.field(r.building).whole(r.surface).field(word_for(surface_kind_words, r.kind));
  text.millimetres(r.p_projected.x).millimetres(r.p_projected.y).millimetres(r.p_projected.z);
  text.millimetres(r.azimuth.degrees()).millimetres(r.tilt.degrees()).millimetres(r.area_m2);
}

void add_area_columns(const std::vector<AreaColumn>& list, CsvText& text) {
  for (const AreaColumn& column : list) {
    if (column.form == NumberForm::rounded && !std::isnan(column.value))
      text.millimetres(column.value);
    else
      text.number(static_cast<float>(column.value));
  }
}

void add_surface(const SurfaceMean& r, const AnswerColumns& columns, bool with_id, CsvText& text) {
  text.field(r.building).whole(r.surface).field(word_for(surface_kind_words, r.kind));
  text.millimetres(r.azimuth.degrees()).millimetres(r.tilt.degrees()).millimetres(r.area_m2);
  text.whole(r.receivers).whole(r.nodata).svf(r.svf_mean).svf(r.svf_min).svf(r.svf_max).millimetres(r.covered_area_m2);
  add_area_columns(area_columns_of(r, columns), text);
  if (with_id) text.field(r.id);
  text.end_row();
}

void add_building(const BuildingMean& r, const AnswerColumns& columns, CsvText& text) {
  const BuildingAreas areas = areas_of(r);
  text.field(r.building).millimetres(areas.roofs_m2).millimetres(areas.walls_m2);
  text.whole(r.receivers).whole(r.nodata).svf(r.svf_roofs).svf(r.svf_walls);
  text.millimetres(areas.covered_roofs_m2).millimetres(areas.covered_walls_m2);
  add_area_columns(area_columns_of(r, columns), text);
  text.end_row();
}

}  // namespace

void CsvText::begin_field() {
  if (!row_begins_) bytes_ += ',';
  row_begins_ = false;
}

CsvText& CsvText::field(std::string_view text) {
  begin_field();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    bytes_ += text;
    return *this;
  }
  bytes_ += '"';
  for (const char c : text) {
    if (c == '"') bytes_ += '"';
    bytes_ += c;
  }
  bytes_ += '"';
  return *this;
}

CsvText& CsvText::whole(std::uint64_t number) {
  begin_field();
  append_whole(bytes_, number);
  return *this;
}

CsvText& CsvText::millimetres(double value) {
  begin_field();
  append_millimetres(bytes_, value);
  return *this;
}

CsvText& CsvText::millimetres(std::optional<double> value) {
  if (value) return millimetres(*value);
  begin_field();
  return *this;
}

CsvText& CsvText::svf(std::optional<double> value) {
  begin_field();
  if (value) append_svf(bytes_, *value);
  return *this;
}

CsvText& CsvText::number(float value) {
  begin_field();
  if (!std::isnan(value)) bytes_ += shortest_decimal(value);
  return *this;
}

CsvText& CsvText::fields(std::initializer_list<std::string_view> texts) {
  for (const std::string_view text : texts) field(text);
  return *this;
}

void CsvText::end_row() {
  bytes_ += '\n';
  row_begins_ = true;
}

void write_points_csv(const PointRows& rows, const AnswerColumns& columns, const std::filesystem::path& path) {
  const std::size_t attributes = rows.attributes == nullptr ? 0 : rows.attributes->names().size();
  write_table(path, point_header(rows, columns), rows.count, [&](std::size_t n, CsvText& text) {
    const PointRow row = rows.row(n);
    text.field(row.id);
    for (std::size_t k = 0; k < attributes; ++k) text.field(rows.attributes->value(n, k));
    add_point(row, text);
    if (rows.normals) text.millimetres(row.azimuth_deg).millimetres(row.tilt_deg);
    add_answer(row, columns, text);
  });
}

SurfacePointsCsv::SurfacePointsCsv(const AnswerColumns& columns, const std::filesystem::path& path)
    : path_(path),
      header_(receiver_header({"building", "surface", "kind", "x_m", "y_m", "z_m", "azimuth_deg", "tilt_deg", "area_m2"}, columns)
                  .bytes()),
      columns_(columns),
      spool_(path) {}

void SurfacePointsCsv::write_part(std::size_t part, std::span<const SurfacePoint> rows) {
  if (rows.empty()) return;
  CsvText text;
  for (const SurfacePoint& row : rows) {
    add_surface_point(row, text);
    add_answer(row, columns_, text);
  }
  const std::string& bytes = text.bytes();
  const bool is_new = parts_.emplace(part, Place{spool_.append(std::as_bytes(std::span(bytes))), bytes.size()}).second;
  FARLOD_EXPECTS(is_new);
}

void SurfacePointsCsv::commit() {
  write_atomically(path_, [this](std::ostream& out) {
    out << header_;
    std::string bytes;
    for (const auto& [part, place] : parts_) {
      bytes.resize(place.bytes);
      spool_.read(place.begin, std::as_writable_bytes(std::span(bytes)));
      out << bytes;
    }
  });
}

void write_surfaces_csv(std::span<const SurfaceMean> rows, const AnswerColumns& columns, const std::filesystem::path& path) {
  const bool with_ids = have_ids(rows);
  CsvText header;
  header.fields({"building", "surface", "kind", "azimuth_deg", "tilt_deg", "area_m2", "receivers", "nodata",
                 columns.quantity + "_mean", columns.quantity + "_min", columns.quantity + "_max", "covered_area_m2"});
  for (const AreaColumn& column : area_columns_of(SurfaceMean{}, columns)) header.field(column.name);
  if (with_ids) header.field("surface_id");
  header.end_row();
  write_table(path, std::move(header), rows.size(),
              [&](std::size_t n, CsvText& text) { add_surface(rows[n], columns, with_ids, text); });
}

void write_buildings_csv(std::span<const BuildingMean> rows, const AnswerColumns& columns, const std::filesystem::path& path) {
  CsvText header;
  header.fields({"building", "roof_area_m2", "wall_area_m2", "receivers", "nodata", columns.quantity + "_roofs",
                 columns.quantity + "_walls", "covered_roof_area_m2", "covered_wall_area_m2"});
  for (const AreaColumn& column : area_columns_of(BuildingMean{}, columns)) header.field(column.name);
  header.end_row();
  write_table(path, std::move(header), rows.size(), [&](std::size_t n, CsvText& text) { add_building(rows[n], columns, text); });
}

std::vector<std::filesystem::path> SurfaceTablesCsv::commit(std::span<const SurfaceMean> surfaces,
                                                            std::span<const BuildingMean> buildings) {
  std::vector<std::filesystem::path> files{path_, table_beside(path_, ".surfaces"), table_beside(path_, ".buildings")};
  write_surfaces_csv(surfaces, columns_, files[1]);
  write_buildings_csv(buildings, columns_, files[2]);
  receivers_.commit();  // the file of -o appears last
  return files;
}

void write_verification_csv(std::span<const VerifiedReceiver> receivers, const std::string& quantity,
                            const std::filesystem::path& path) {
  CsvText text;
  text.fields({"x_m", "y_m", "z_m", quantity, quantity + "_exact"}).end_row();
  for (const VerifiedReceiver& r : receivers) {
    text.millimetres(r.p_projected.x).millimetres(r.p_projected.y).millimetres(r.p_projected.z);
    text.svf(r.svf).svf(r.exact).end_row();
  }
  write_atomically(path, [&text](std::ostream& file) { file << text.bytes(); });
}

}  // namespace farlod
