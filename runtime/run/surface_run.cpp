// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/run_settings.hpp"
#include "evaluate/quantity_table.hpp"
#include "farlod/building_origin.hpp"
#include "farlod/error.hpp"
#include "farlod/surfaces.hpp"
#include "package/sources_file.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/point_receivers.hpp"
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
    if (r.is_inside_building) continue;
    result.receivers.push_back({k, r.p_cell, r.normal});
    result.areas_m2.push_back(r.area_m2);
  }
  return result;
}

/// Who and where a receiver is; its answer is to come.
SurfacePoint point_of(const package::Manifest& m, Cell cell, const BlockTiles& block, const TileView& tile,
                      const SurfaceReceiver& r) {
  const package::SurfaceRecord& surface = tile.surface_of(r.triangle);
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
  const TileView tile = package.tile(cell);
  std::vector<SurfacePoint> points;
  points.reserve(receivers.size());
  for (const SurfaceReceiver& r : receivers) points.push_back(point_of(package.manifest(), cell, block, tile, r));
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

/// Means need a row and its keys for each surface, which has a polygon at least, and for each building, whose further values are
/// those of its roofs and those of its walls.
MemoryNeeds needs_of(const PackageReader& package, const SkySettings& sky, std::span<const Cell> cells) {
  const package::Manifest& manifest = package.manifest();
  constexpr double bytes_of_row = 384, bytes_of_value = sizeof(AreaMean) + sizeof(double);
  const double of_further = bytes_of_value * static_cast<double>(columns_of(sky.further).size());
  return {static_cast<double>(manifest.polygons) * (bytes_of_row + of_further) +
              static_cast<double>(manifest.buildings) * (bytes_of_row + 2.0 * of_further),
          0.0, any_traces_whole_city(package, sky.engine, cells)};
}

WantedIrradiation wanted_irradiation(const SurfaceSettings& surfaces, const Quantities& quantities) {
  const ColumnRange columns = range_of(Quantity::irradiation, quantities);
  return {columns.count > 0 ? std::optional(columns.first) : std::nullopt, surfaces.irradiation_threshold_kwh_m2};
}

/// Roofs and walls cell by cell, and their means. All must outlive it.
class SurfaceCells final : public CellsOfRun {
 public:
  SurfaceCells(const PackageReader& package, const std::vector<Cell>& cells, const SurfaceSettings& surfaces,
               const ResolvedSettings& settings, const OnSurfacePoints& on_points)
      : package_(package),
        cells_(cells),
        surfaces_(surfaces),
        settings_(settings),
        on_points_(on_points),
        placed_(cells.size()),
        surface_averages_(wanted_irradiation(surfaces, settings.sky.further)),
        building_averages_(wanted_irradiation(surfaces, settings.sky.further)) {}

  [[nodiscard]] std::size_t size() const override { return cells_.size(); }
  [[nodiscard]] Cell place(std::size_t n) const override { return cells_[n]; }
  /// The larger the tile, the more surfaces it has.
  [[nodiscard]] double receivers_about(std::size_t n) const override {
    return static_cast<double>(package_.files_of(cells_[n]).tiles.bytes);
  }
  [[nodiscard]] CellReceivers receivers(std::size_t n) override {
    PlacedReceivers receivers = placed_on_surfaces(package_, cells_[n], surfaces_, settings_);
    CellReceivers result = answerable(cells_[n], receivers);
    if (n >= stored_ && !settings_.run.shard) placed_[n] = std::move(receivers.receivers);
    return result;
  }
  /// Hands points on with the cell's place in CellRange::index_of.
  void store(std::size_t n, const CellReceivers& cell, const SvfValues& values) override {
    const std::size_t index = package_.grid().cells.index_of(cells_[n]);
    const std::vector<SurfacePoint> points = points_of(package_, cells_[n], placed_[n], cell.receivers, values);
    if (on_points_) on_points_(index, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      surface_averages_.add({index, k}, points[k]);
      building_averages_.add({index, k}, points[k]);
    }
    receivers_ += points.size();
    placed_[n] = {};
    ++stored_;
  }
  [[nodiscard]] SurfaceMeans means(EvaluationSummary summary) const {
    summary.no_data = receivers_ - summary.receivers;
    return {surface_averages_.rows(), building_averages_.rows(), summary};
  }

 private:
  const PackageReader& package_;
  const std::vector<Cell>& cells_;
  const SurfaceSettings& surfaces_;
  const ResolvedSettings& settings_;
  const OnSurfacePoints& on_points_;
  /// What is known of a cell's receivers, from when they are placed until their answers are there.
  std::vector<std::vector<SurfaceReceiver>> placed_;
  std::atomic<std::size_t> stored_ = 0;  ///< cells; a verification asks for the receivers of some of them again
  SurfaceAverages surface_averages_;
  BuildingAverages building_averages_;
  std::size_t receivers_ = 0;
};

void check(const SurfaceSettings& surfaces, const Quantities& quantities) {
  require_one_of("choice", surfaces.choice, SurfaceChoice::all);
  require_between("spacing_m", surfaces.spacing_m, 0.05, 1000.0);
  if (quantities.any_of_places())
    throw InvalidArgument(
        "further.view_cube, view_sphere and view_eye are those of a place, and a surface hides half of what is around: leave "
        "them out, or evaluate points");
  if (!surfaces.irradiation_threshold_kwh_m2) return;
  require_between("irradiation_threshold_kwh_m2", *surfaces.irradiation_threshold_kwh_m2, 0.0, 100'000.0);
  if (!quantities.irradiation)
    throw InvalidArgument("irradiation_threshold_kwh_m2 is one of irradiation: ask for that, too (further.irradiation)");
}

void name_surfaces(const std::vector<SurfaceMean*>& surfaces, const std::vector<SurfaceIds>& ids) {
  for (SurfaceMean* surface : surfaces) {
    const auto of = std::ranges::upper_bound(ids, surface->surface, {}, &SurfaceIds::end);
    if (of == ids.end() || surface->surface < of->begin) continue;
    surface->id = (of->behind_building_id ? surface->building : std::string()) + of->id;
  }
}

/// Names surfaces as their city file does. A row of several buildings that share an id may be of any of them, and gets no name.
void name_surfaces(SurfaceMeans& means, const SourcesFile& sources) {
  std::unordered_map<std::string_view, std::vector<SurfaceMean*>> of_building;
  for (SurfaceMean& surface : means.surfaces) of_building[surface.building].push_back(&surface);
  for (const BuildingMean& building : means.buildings) {
    if (building.building_numbers.size() != 1) continue;
    const std::optional<BuildingOrigin> origin = sources.find(building.building_numbers.front());
    if (origin) name_surfaces(of_building[building.building], origin->ids);
  }
}

}  // namespace

SurfaceMeans evaluate_surfaces(const Package& package, const SurfaceSettings& surfaces, const EvaluationSettings& evaluation,
                               const OnSurfacePoints& on_points, const RunSettings& run) {
  ResolvedSettings settings = resolved(evaluation, run);
  settings.sky.on_surfaces = true;
  check(surfaces, evaluation.further);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const std::vector<Cell> cells = along_hilbert_curve(all_cells(reader.grid().cells), reader.grid().block_edge);
  const double memory_bytes = require_memory(reader.manifest(), settings, needs_of(reader, settings.sky, cells));
  // Before the work: what is damaged is told at once
  std::optional<SourcesFile> sources;
  if (reader.manifest().sources) sources.emplace(reader.folder(), reader.manifest());
  SurfaceCells surface_cells(reader, cells, surfaces, settings, on_points);
  EvaluationSummary summary = evaluate_cells(in_use, settings, surface_cells);
  if (settings.run.shard) return {{}, {}, std::move(summary)};
  SurfaceMeans means = surface_cells.means(summary.estimate ? with_memory(std::move(summary), memory_bytes) : std::move(summary));
  if (sources) name_surfaces(means, *sources);
  return means;
}

}  // namespace farlod
