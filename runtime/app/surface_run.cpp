// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "app/evaluation.hpp"
#include "app/memory_limit.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/surface_receivers.hpp"
#include "results/table/surface_averages.hpp"

namespace farlod {
namespace {

CellReceivers answerable(Cell cell, std::span<const SurfaceReceiver> receivers) {
  CellReceivers result{cell, {}};
  for (std::size_t k = 0; k < receivers.size(); ++k)
    if (!receivers[k].is_inside_building) result.receivers.push_back({k, receivers[k].p_cell, receivers[k].normal});
  return result;
}

/// True azimuth of a normal; 0 for one that looks straight up, which has none.
Angle true_azimuth(const Point3d& normal_grid, const package::Manifest& m) {
  const Point2d n_city = m.grid.rotation.city_from_grid(horizontal(normal_grid));
  if (n_city == Point2d{}) return {};
  const double azimuth_deg = azimuth_of(n_city).degrees() + m.convergence.degrees();
  return Angle::degrees(azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0));
}

/// Who and where a receiver is; its answer is to come.
SurfacePointRow row_of(const Package& package, Cell cell, const BlockTiles& block, const SurfaceReceiver& r) {
  const package::Manifest& m = package.manifest();
  const package::SurfaceRecord& surface = block.tile(cell).surface_of(r.triangle);
  const Point2d corner = m.grid.corner_of(cell);
  const Point3d normal{r.normal.x, r.normal.y, r.normal.z};
  SurfacePointRow row;
  row.building = block.id_of(block.buildings()[surface.building]);
  row.surface = surface.number;
  row.kind = surface.kind();
  row.p_projected = m.projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, r.p_cell.z + m.height_origin_m});
  row.azimuth = true_azimuth(normal, m);
  row.tilt = Angle::radians(std::acos(std::clamp(normal.z, -1.0, 1.0)));
  row.area_m2 = r.area_m2;
  return row;
}

/// All receivers of a cell, those with an answer and those without.
std::vector<SurfacePointRow> rows_of(const Package& package, Cell cell, std::span<const SurfaceReceiver> receivers,
                                     std::span<const Receiver> answered, const SvfValues& values) {
  const BlockTiles& block = package.block_tiles(cell);
  std::vector<SurfacePointRow> rows;
  rows.reserve(receivers.size());
  for (const SurfaceReceiver& r : receivers) rows.push_back(row_of(package, cell, block, r));
  for (std::size_t k = 0; k < answered.size(); ++k) {
    SurfacePointRow& row = rows[answered[k].index];
    row.svf = SvfValues::value(values.svf, k);
    row.low = SvfValues::value(values.low, k);
    row.high = SvfValues::value(values.high, k);
  }
  return rows;
}

/// The tables of a run. Rows come cell by cell along a curve, and are written in the order of CellRange::index_of.
class SurfaceTables {
 public:
  explicit SurfaceTables(const SvfOptions& options)
      : writer_(options.format->surface_tables_writer(answer_columns(options), options.output)) {}

  void add(std::size_t cell_index, std::span<const SurfacePointRow> rows) {
    writer_->write_part(cell_index, rows);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      surfaces_.add({cell_index, k}, rows[k]);
      buildings_.add({cell_index, k}, rows[k]);
    }
  }
  [[nodiscard]] std::vector<std::filesystem::path> commit() { return writer_->commit(surfaces_.rows(), buildings_.rows()); }

 private:
  std::unique_ptr<SurfaceTablesWriter> writer_;
  SurfaceAverages surfaces_;
  BuildingAverages buildings_;
};

std::vector<Cell> all_cells(const CellRange& range) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return cells;
}

/// Averages need a row and its keys for each surface, which has a polygon at least, and for each building.
MemoryNeeds needs_of(const package::Manifest& manifest) {
  constexpr std::uint64_t bytes_of_surface = 320, bytes_of_building = 320;
  return {manifest.polygons * bytes_of_surface + manifest.buildings * bytes_of_building, 0, false};
}

/// A run over the surfaces of a city.
class SurfaceRun {
 public:
  SurfaceRun(Package& package, const SvfOptions& options)
      : package_(package),
        options_(options),
        cells_(along_hilbert_curve(all_cells(package.grid().cells), package.grid().block_edge)),
        tables_(options),
        placed_(cells_.size()) {
    share_memory(package, options, needs_of(package.manifest()));
  }

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] CellReceivers receivers_of(std::size_t n) {
    placed_[n] = surface_receivers(package_, cells_[n], options_.surfaces, options_.spacing_m);
    return answerable(cells_[n], placed_[n]);
  }
  void store(std::size_t n, const CellReceivers& cell, const SvfValues& values) {
    tables_.add(package_.grid().cells.index_of(cells_[n]), rows_of(package_, cells_[n], placed_[n], cell.receivers, values));
    receiver_count_ += placed_[n].size();
    placed_[n] = {};
  }
  void finish(SvfRun& run) {
    run.inside_buildings = receiver_count_ - run.receivers;
    run.files = tables_.commit();
  }

 private:
  const Package& package_;
  const SvfOptions& options_;
  std::vector<Cell> cells_;
  SurfaceTables tables_;
  /// What is known of a cell's receivers, from when they are placed until their answers are there.
  std::vector<std::vector<SurfaceReceiver>> placed_;
  std::size_t receiver_count_ = 0;
};

}  // namespace

SvfRun run_surfaces(Package& package, const SvfOptions& options) {
  SurfaceRun surfaces(package, options);
  return evaluate_and_finish(package, options, surfaces);
}

}  // namespace farlod
