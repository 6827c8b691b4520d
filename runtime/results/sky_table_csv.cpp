// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/sky_table_csv.hpp"

#include <initializer_list>
#include <ostream>
#include <string_view>
#include <utility>

#include "farlod/expects.hpp"
#include "results/atomic_file.hpp"
#include "results/csv_text.hpp"

namespace farlod {
namespace {

// A thousandth of a degree is 1.7 cm over a kilometre
double degrees(Angle angle) { return angle.degrees(); }

std::string_view word_for(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::ground:
      return "ground";
    case SurfaceKind::roof:
      return "roof";
    case SurfaceKind::wall:
      return "wall";
    case SurfaceKind::foundation:
      return "foundation";
    case SurfaceKind::floor:
      return "floor";
    case SurfaceKind::unknown:
      break;
  }
  return "unknown";
}

/// Rows as text, a few at a time.
constexpr std::size_t rows_at_once = 1024;

template <class Row>
void write_table(const std::filesystem::path& path, std::initializer_list<std::string_view> header, std::span<const Row> rows,
                 void (*add)(const Row&, CsvText&)) {
  write_text_atomically(path, [&](std::ostream& out) {
    CsvText text;
    text.fields(header).end_row();
    for (std::size_t n = 0; n < rows.size(); ++n) {
      add(rows[n], text);
      if (n % rows_at_once == 0) out << std::exchange(text, {}).bytes();
    }
    out << text.bytes();
  });
}

/// The columns of a table of receivers: who and where each is, then its answer, then its bounds where they are wanted.
void add_receiver_header(std::initializer_list<std::string_view> identity, const std::string& quantity, BoundsColumns bounds,
                         CsvText& text) {
  text.fields(identity).field(quantity);
  if (bounds == BoundsColumns::yes) text.fields({quantity + "_low", quantity + "_high"});
  text.end_row();
}

template <class Row>
void add_answer(const Row& row, BoundsColumns bounds, CsvText& text) {
  text.share(row.svf);
  if (bounds == BoundsColumns::yes) text.share(row.low).share(row.high);
  text.end_row();
}

void add_point(const PointRow& r, CsvText& text) {
  text.field(r.id).millimetres(r.p_projected.x).millimetres(r.p_projected.y).millimetres(r.height_m);
}

void add_surface_point(const SurfacePointRow& r, CsvText& text) {
  text.field(r.building).whole(r.surface).field(word_for(r.kind));
  text.millimetres(r.p_projected.x).millimetres(r.p_projected.y).millimetres(r.p_projected.z);
  text.millimetres(degrees(r.azimuth)).millimetres(degrees(r.tilt)).millimetres(r.area_m2);
}

void add_surface(const SurfaceRow& r, CsvText& text) {
  text.field(r.building).whole(r.surface).field(word_for(r.kind));
  text.millimetres(degrees(r.azimuth)).millimetres(degrees(r.tilt)).millimetres(r.area_m2);
  text.whole(r.receivers).whole(r.nodata).share(r.svf_mean).share(r.svf_min).share(r.svf_max).end_row();
}

void add_building(const BuildingRow& r, CsvText& text) {
  text.field(r.building).millimetres(r.roof_area_m2).millimetres(r.wall_area_m2);
  text.whole(r.receivers).whole(r.nodata).share(r.svf_roofs).share(r.svf_walls).end_row();
}

}  // namespace

void write_points_csv(std::size_t count, const std::function<PointRow(std::size_t n)>& row_of, const std::string& quantity,
                      BoundsColumns bounds, const std::filesystem::path& path) {
  write_text_atomically(path, [&](std::ostream& out) {
    CsvText text;
    add_receiver_header({"id", "x_m", "y_m", "z_m"}, quantity, bounds, text);
    for (std::size_t n = 0; n < count; ++n) {
      const PointRow row = row_of(n);
      add_point(row, text);
      add_answer(row, bounds, text);
      if (n % rows_at_once == 0) out << std::exchange(text, {}).bytes();
    }
    out << text.bytes();
  });
}

void write_points_csv(std::span<const PointRow> rows, const std::string& quantity, BoundsColumns bounds,
                      const std::filesystem::path& path) {
  write_points_csv(
      rows.size(), [rows](std::size_t n) { return rows[n]; }, quantity, bounds, path);
}

SurfacePointsCsv::SurfacePointsCsv(const std::filesystem::path& path, const std::string& quantity, BoundsColumns bounds)
    : path_(path), bounds_(bounds), waiting_(path) {
  CsvText header;
  add_receiver_header({"building", "surface", "kind", "x_m", "y_m", "z_m", "azimuth_deg", "tilt_deg", "area_m2"}, quantity,
                      bounds, header);
  header_ = header.bytes();
}

void SurfacePointsCsv::write_part(std::size_t part, std::span<const SurfacePointRow> rows) {
  if (rows.empty()) return;
  CsvText text;
  for (const SurfacePointRow& row : rows) {
    add_surface_point(row, text);
    add_answer(row, bounds_, text);
  }
  const std::string& bytes = text.bytes();
  const bool is_new = parts_.emplace(part, Place{waiting_.append(std::as_bytes(std::span(bytes))), bytes.size()}).second;
  FARLOD_EXPECTS(is_new);
}

void SurfacePointsCsv::commit() {
  write_text_atomically(path_, [this](std::ostream& out) {
    out << header_;
    std::string bytes;
    for (const auto& [part, place] : parts_) {
      bytes.resize(place.bytes);
      waiting_.read(place.begin, std::as_writable_bytes(std::span(bytes)));
      out << bytes;
    }
  });
}

void write_surface_points_csv(std::span<const SurfacePointRow> rows, const std::string& quantity, BoundsColumns bounds,
                              const std::filesystem::path& path) {
  SurfacePointsCsv table(path, quantity, bounds);
  table.write_part(0, rows);
  table.commit();
}

void write_surfaces_csv(std::span<const SurfaceRow> rows, const std::string& quantity, const std::filesystem::path& path) {
  write_table(path,
              {"building", "surface", "kind", "azimuth_deg", "tilt_deg", "area_m2", "receivers", "nodata", quantity + "_mean",
               quantity + "_min", quantity + "_max"},
              rows, add_surface);
}

void write_buildings_csv(std::span<const BuildingRow> rows, const std::string& quantity, const std::filesystem::path& path) {
  write_table(path, {"building", "roof_area_m2", "wall_area_m2", "receivers", "nodata", quantity + "_roofs", quantity + "_walls"},
              rows, add_building);
}

}  // namespace farlod
