// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/sky_table_csv.hpp"

#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

#include "farlod/expects.hpp"
#include "results/atomic_file.hpp"
#include "results/csv_row.hpp"
#include "results/decimal.hpp"

namespace farlod {
namespace {

using Fields = std::vector<std::string>;

std::string share(const std::optional<double>& svf) { return svf ? share_decimal(*svf) : std::string(); }

// A thousandth of a degree is 1.7 cm over a kilometre
std::string degrees(Angle angle) { return millimetre_decimal(angle.degrees()); }

std::string word_for(SurfaceKind kind) {
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

template <class Row>
void write_table(const std::filesystem::path& path, const Fields& header, std::span<const Row> rows,
                 Fields (*fields_of)(const Row&)) {
  write_text_atomically(path, [&](std::ostream& out) {
    write_csv_row(out, header);
    for (const Row& row : rows) write_csv_row(out, fields_of(row));
  });
}

/// The columns of a table of receivers: who and where each is, then its answer, then its bounds where they are wanted.
Fields receiver_header(Fields header, const std::string& quantity, BoundsColumns bounds) {
  header.push_back(quantity);
  if (bounds == BoundsColumns::yes) header.insert(header.end(), {quantity + "_low", quantity + "_high"});
  return header;
}

template <class Row>
void write_receiver(std::ostream& out, Fields identity, const Row& row, BoundsColumns bounds) {
  identity.push_back(share(row.svf));
  if (bounds == BoundsColumns::yes) identity.insert(identity.end(), {share(row.low), share(row.high)});
  write_csv_row(out, identity);
}

Fields point_fields(const PointRow& r) {
  return {r.id, millimetre_decimal(r.p_projected.x), millimetre_decimal(r.p_projected.y),
          r.height_m ? millimetre_decimal(*r.height_m) : std::string()};
}

Fields surface_point_fields(const SurfacePointRow& r) {
  return {r.building,
          std::to_string(r.surface),
          word_for(r.kind),
          millimetre_decimal(r.p_projected.x),
          millimetre_decimal(r.p_projected.y),
          millimetre_decimal(r.p_projected.z),
          degrees(r.azimuth),
          degrees(r.tilt),
          millimetre_decimal(r.area_m2)};
}

Fields surface_fields(const SurfaceRow& r) {
  return {r.building,
          std::to_string(r.surface),
          word_for(r.kind),
          degrees(r.azimuth),
          degrees(r.tilt),
          millimetre_decimal(r.area_m2),
          std::to_string(r.receivers),
          std::to_string(r.nodata),
          share(r.svf_mean),
          share(r.svf_min),
          share(r.svf_max)};
}

Fields building_fields(const BuildingRow& r) {
  return {r.building,
          millimetre_decimal(r.roof_area_m2),
          millimetre_decimal(r.wall_area_m2),
          std::to_string(r.receivers),
          std::to_string(r.nodata),
          share(r.svf_roofs),
          share(r.svf_walls)};
}

}  // namespace

void write_points_csv(std::size_t count, const std::function<PointRow(std::size_t n)>& row_of, const std::string& quantity,
                      BoundsColumns bounds, const std::filesystem::path& path) {
  write_text_atomically(path, [&](std::ostream& out) {
    write_csv_row(out, receiver_header({"id", "x_m", "y_m", "z_m"}, quantity, bounds));
    for (std::size_t n = 0; n < count; ++n) {
      const PointRow row = row_of(n);
      write_receiver(out, point_fields(row), row, bounds);
    }
  });
}

void write_points_csv(std::span<const PointRow> rows, const std::string& quantity, BoundsColumns bounds,
                      const std::filesystem::path& path) {
  write_points_csv(
      rows.size(), [rows](std::size_t n) { return rows[n]; }, quantity, bounds, path);
}

SurfacePointsCsv::SurfacePointsCsv(const std::filesystem::path& path, const std::string& quantity, BoundsColumns bounds)
    : path_(path), bounds_(bounds), waiting_(path) {
  std::ostringstream header;
  write_csv_row(header,
                receiver_header({"building", "surface", "kind", "x_m", "y_m", "z_m", "azimuth_deg", "tilt_deg", "area_m2"},
                                quantity, bounds));
  header_ = header.str();
}

void SurfacePointsCsv::write_part(std::size_t part, std::span<const SurfacePointRow> rows) {
  if (rows.empty()) return;
  std::ostringstream text;
  for (const SurfacePointRow& row : rows) write_receiver(text, surface_point_fields(row), row, bounds_);
  const std::string bytes = text.str();
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
              rows, surface_fields);
}

void write_buildings_csv(std::span<const BuildingRow> rows, const std::string& quantity, const std::filesystem::path& path) {
  write_table(path, {"building", "roof_area_m2", "wall_area_m2", "receivers", "nodata", quantity + "_roofs", quantity + "_walls"},
              rows, building_fields);
}

}  // namespace farlod
