// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/sky_table_csv.hpp"

#include <ostream>
#include <vector>

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

/// A row for each receiver: who and where it is, then its answer, then its bounds where they are wanted.
template <class Row>
void write_receivers(const std::filesystem::path& path, Fields header, const std::string& quantity, BoundsColumns bounds,
                     std::span<const Row> rows, Fields (*identity)(const Row&)) {
  header.push_back(quantity);
  if (bounds == BoundsColumns::yes) header.insert(header.end(), {quantity + "_low", quantity + "_high"});
  write_text_atomically(path, [&](std::ostream& out) {
    write_csv_row(out, header);
    for (const Row& row : rows) {
      Fields fields = identity(row);
      fields.push_back(share(row.svf));
      if (bounds == BoundsColumns::yes) fields.insert(fields.end(), {share(row.low), share(row.high)});
      write_csv_row(out, fields);
    }
  });
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

void write_points_csv(std::span<const PointRow> rows, const std::string& quantity, BoundsColumns bounds,
                      const std::filesystem::path& path) {
  write_receivers(path, {"id", "x_m", "y_m", "z_m"}, quantity, bounds, rows, point_fields);
}

void write_surface_points_csv(std::span<const SurfacePointRow> rows, const std::string& quantity, BoundsColumns bounds,
                              const std::filesystem::path& path) {
  write_receivers(path, {"building", "surface", "kind", "x_m", "y_m", "z_m", "azimuth_deg", "tilt_deg", "area_m2"}, quantity,
                  bounds, rows, surface_point_fields);
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
