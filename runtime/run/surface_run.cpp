// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <utility>

#include "base/run_settings.hpp"
#include "farlod/surfaces.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/surface_receivers.hpp"
#include "run/facing.hpp"
#include "run/memory_limit.hpp"
#include "run/ordered_run.hpp"
#include "run/surface_averages.hpp"

namespace farlod {
namespace {

/// The receivers of a cell that somebody asks for, and the number of the others.
struct PlacedReceivers {
  std::vector<SurfaceReceiver> receivers;
  std::size_t outside_of_region = 0;
};
PlacedReceivers placed_on_surfaces(const PackageReader& package, Cell cell, const SurfaceSettings& surfaces,
                                   const ResolvedSettings& settings) {
  PlacedReceivers placed{surface_receivers(package, cell, surfaces.choice, surfaces.spacing_m, settings.run.stop)};
  if (settings.region == nullptr) return placed;
  const package::Manifest& m = package.manifest();
  const Point2d corner = m.grid.corner_of(cell);
  placed.outside_of_region = std::erase_if(placed.receivers, [&](const SurfaceReceiver& r) {
    return !settings.wants(horizontal(m.projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, 0.0})));
  });
  return placed;
}

CellReceivers answerable(Cell cell, const PlacedReceivers& placed) {
  CellReceivers result{cell, {}};
  result.outside_of_region = placed.outside_of_region;
  for (std::size_t k = 0; k < placed.receivers.size(); ++k) {
    const SurfaceReceiver& r = placed.receivers[k];
    if (!r.is_inside_building) result.receivers.push_back({k, r.p_cell, r.normal});
  }
  return result;
}

/// Who and where a receiver is; its answer is to come.
SurfacePoint point_of(const package::Manifest& m, Cell cell, const BlockTiles& block, const SurfaceReceiver& r) {
  const package::SurfaceRecord& surface = block.tile(cell).surface_of(r.triangle);
  const Point2d corner = m.grid.corner_of(cell);
  const Point3d normal{r.normal.x, r.normal.y, r.normal.z};
  SurfacePoint point;
  point.building = block.id_of(block.buildings()[surface.building]);
  point.building_number = block.buildings()[surface.building].number;
  point.surface = surface.number;
  point.kind = surface.kind();
  point.p_projected = m.projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, r.p_cell.z + m.height_origin_m});
  const Facing facing = facing_of(normal, m);
  point.azimuth = facing.azimuth;
  point.tilt = facing.tilt;
  point.area_m2 = r.area_m2;
  return point;
}

/// All receivers of a cell, those with an answer and those without.
std::vector<SurfacePoint> points_of(const PackageReader& package, Cell cell, std::span<const SurfaceReceiver> receivers,
                                    std::span<const Receiver> answered, const SvfValues& values) {
  const BlockTiles& block = package.block_tiles(cell);
  std::vector<SurfacePoint> points;
  points.reserve(receivers.size());
  for (const SurfaceReceiver& r : receivers) points.push_back(point_of(package.manifest(), cell, block, r));
  for (std::size_t k = 0; k < answered.size(); ++k) {
    SurfacePoint& point = points[answered[k].index];
    point.svf = SvfValues::value(values.svf, k);
    point.low = SvfValues::value(values.low, k);
    point.high = SvfValues::value(values.high, k);
    if (const auto further = values.further_of(k); point.svf) point.further.assign(further.begin(), further.end());
  }
  return points;
}

std::vector<Cell> all_cells(const CellRange& range) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return cells;
}

/// Means need a row and its keys for each surface, which has a polygon at least, and for each building.
MemoryNeeds needs_of(const PackageReader& package, Engine engine, std::span<const Cell> cells) {
  const package::Manifest& manifest = package.manifest();
  constexpr double bytes_of_surface = 320, bytes_of_building = 320;
  return {static_cast<double>(manifest.polygons) * bytes_of_surface + static_cast<double>(manifest.buildings) * bytes_of_building,
          0.0, any_traces_whole_city(package, engine, cells)};
}

/// The means of a run. Points come cell by cell along a curve, and are handed on with the cell's place in CellRange::index_of.
class MeansOfRun {
 public:
  explicit MeansOfRun(const OnSurfacePoints& on_points) : on_points_(on_points) {}

  void add(std::size_t cell_index, std::span<const SurfacePoint> points) {
    if (on_points_) on_points_(cell_index, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      surfaces_.add({cell_index, k}, points[k]);
      buildings_.add({cell_index, k}, points[k]);
    }
    receivers_ += points.size();
  }
  [[nodiscard]] SurfaceMeans with(EvaluationSummary summary) const {
    summary.no_data = receivers_ - summary.receivers;
    return {surfaces_.rows(), buildings_.rows(), summary};
  }

 private:
  const OnSurfacePoints& on_points_;
  SurfaceAverages surfaces_;
  BuildingAverages buildings_;
  std::size_t receivers_ = 0;
};

void check(const SurfaceSettings& surfaces) {
  require_one_of("choice", surfaces.choice, SurfaceChoice::all);
  require_between("spacing_m", surfaces.spacing_m, 0.05, 1000.0);
}

/// The larger the tile, the more surfaces it has.
CellsOfRun cells_of_run(const PackageReader& reader, const std::vector<Cell>& cells, ReceiversOfCell receivers_of) {
  return {cells.size(), std::move(receivers_of),
          [&](std::size_t n) { return static_cast<double>(reader.files_of(cells[n]).tiles.bytes); },
          [&](std::size_t n) { return cells[n]; }};
}

}  // namespace

SurfaceMeans evaluate_surfaces(const Package& package, const SurfaceSettings& surfaces, const EvaluationSettings& evaluation,
                               const OnSurfacePoints& on_points, const RunSettings& run) {
  const ResolvedSettings settings = resolved(evaluation, run);
  check(surfaces);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const CellRange& range = reader.grid().cells;
  const std::vector<Cell> cells = along_hilbert_curve(all_cells(range), reader.grid().block_edge);
  const double memory_bytes = require_memory(reader.manifest(), settings, needs_of(reader, settings.sky.engine, cells));
  MeansOfRun means(on_points);
  // What is known of a cell's receivers, from when they are placed until their answers are there
  std::vector<std::vector<SurfaceReceiver>> placed(cells.size());
  std::atomic<std::size_t> stored = 0;  // cells, in their order; a verification asks for the receivers of some of them again
  const auto receivers_of = [&](std::size_t n) {
    PlacedReceivers receivers = placed_on_surfaces(reader, cells[n], surfaces, settings);
    CellReceivers result = answerable(cells[n], receivers);
    if (n >= stored && !settings.run.shard) placed[n] = std::move(receivers.receivers);
    return result;
  };
  const auto store = [&](std::size_t n, const CellReceivers& cell, const SvfValues& values) {
    means.add(range.index_of(cells[n]), points_of(reader, cells[n], placed[n], cell.receivers, values));
    placed[n] = {};
    ++stored;
  };
  EvaluationSummary summary = evaluate_cells(in_use, settings, cells_of_run(reader, cells, receivers_of), store);
  if (settings.run.shard) return {{}, {}, std::move(summary)};
  return means.with(summary.estimate ? with_memory(std::move(summary), memory_bytes) : std::move(summary));
}

}  // namespace farlod
