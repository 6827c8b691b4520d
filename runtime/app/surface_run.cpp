// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/evaluation.hpp"
#include "receivers/surface_receivers.hpp"
#include "results/sky_table_csv.hpp"
#include "results/surface_averages.hpp"

namespace farlod {
namespace {

/// The receivers of one cell, those with an answer and those without, and where their answers begin.
struct CellSurfaces {
  Cell cell;
  std::vector<SurfaceReceiver> receivers;
  std::size_t first_index = 0;
};

std::vector<CellSurfaces> collect(const Package& package, const SvfOptions& options) {
  const CellRange& range = package.grid().cells;
  std::vector<CellSurfaces> cells(static_cast<std::size_t>(range.size()));
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    cells[n] = {range.cell_at(n), surface_receivers(package, range.cell_at(n), options.surfaces, options.spacing_m), 0};
  });
  std::size_t next = 0;
  for (CellSurfaces& c : cells) {
    c.first_index = next;
    next += c.receivers.size();
  }
  return cells;
}

CellReceivers answerable(const CellSurfaces& cell) {
  CellReceivers result{cell.cell, {}};
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
    const SurfaceReceiver& r = cell.receivers[k];
    if (!r.is_inside_building) result.receivers.push_back({cell.first_index + k, r.p_cell, r.normal});
  }
  return result;
}

/// True azimuth of a normal; 0 for one that looks straight up, which has none.
Angle true_azimuth(const Point3d& normal_grid, const package::Manifest& m) {
  const Point2d n_city = m.grid.rotation.city_from_grid(horizontal(normal_grid));
  if (n_city == Point2d{}) return {};
  const double azimuth_deg = azimuth_of(n_city).degrees() + m.convergence.degrees();
  return Angle::degrees(azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0));
}

SurfacePointRow row_of(const Package& package, const CellSurfaces& cell, const SurfaceReceiver& r, const AnswerTable& answers,
                       std::size_t n) {
  const package::Manifest& m = package.manifest();
  const BlockTiles& block = package.block_tiles(cell.cell);
  const package::SurfaceRecord& surface = block.tile(cell.cell).surface_of(r.triangle);
  const Point2d corner = m.grid.corner_of(cell.cell);
  const Point3d normal{r.normal.x, r.normal.y, r.normal.z};
  SurfacePointRow row;
  row.building = block.id_of(block.buildings()[surface.building]);
  row.surface = surface.number;
  row.kind = surface.kind;
  row.p_projected = m.projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, r.p_cell.z + m.height_origin_m});
  row.azimuth = true_azimuth(normal, m);
  row.tilt = Angle::radians(std::acos(std::clamp(normal.z, -1.0, 1.0)));
  row.area_m2 = r.area_m2;
  row.svf = AnswerTable::value(answers.svf, n);
  row.low = AnswerTable::value(answers.low, n);
  row.high = AnswerTable::value(answers.high, n);
  return row;
}

/// OUT.csv → OUT.surfaces.csv
std::filesystem::path beside(const std::filesystem::path& output, const std::string& what) {
  return std::filesystem::path(output).replace_extension(what + output.extension().string());
}

void write_tables(std::span<const SurfacePointRow> rows, const SvfOptions& options, SvfRun& run) {
  const std::string quantity = quantity_name(options.sky.weight);
  run.files = {options.output, beside(options.output, ".surfaces"), beside(options.output, ".buildings")};
  write_surface_points_csv(rows, quantity, options.bounds ? BoundsColumns::yes : BoundsColumns::no, run.files[0]);
  write_surfaces_csv(average_by_surface(rows), quantity, run.files[1]);
  write_buildings_csv(average_by_building(rows), quantity, run.files[2]);
}

}  // namespace

SvfRun run_surfaces(const Package& package, const SvfOptions& options) {
  const std::vector<CellSurfaces> cells = collect(package, options);
  const std::size_t count = cells.empty() ? 0 : cells.back().first_index + cells.back().receivers.size();
  AnswerTable answers(count, options.bounds);
  SvfRun run;
  evaluate_cells(
      package, options, cells.size(), [&](std::size_t n) { return answerable(cells[n]); }, answers, run);
  run.inside_buildings = count - run.receivers;
  const auto start = std::chrono::steady_clock::now();
  std::vector<SurfacePointRow> rows;
  rows.reserve(count);
  for (const CellSurfaces& cell : cells)
    for (std::size_t k = 0; k < cell.receivers.size(); ++k)
      rows.push_back(row_of(package, cell, cell.receivers[k], answers, cell.first_index + k));
  write_tables(rows, options, run);
  run.seconds.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace farlod
