// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/view_factor_matrix.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <utility>

#include "base/run_settings.hpp"
#include "evaluate/sky_directions.hpp"
#include "farlod/error.hpp"
#include "receivers/point_receivers.hpp"
#include "run/cells_in_parallel.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"
#include "run/reciprocal_rows.hpp"
#include "run/resolved_settings.hpp"
#include "run/seen_columns.hpp"
#include "run/surface_views.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {
namespace {

/// Receivers by the rows of their surfaces: each row's in the order of cells and tiles.
class ReceiversOfRows {
 public:
  ReceiversOfRows(const PackageReader& package, const WholeCity& city, const SurfaceSettings& surfaces, const SurfaceRows& rows,
                  std::size_t row_count, const RunSettings& run)
      : ends_(row_count + 1, 0) {
    const CellRange& cells = package.grid().cells;
    std::vector<std::vector<Placed>> placed(static_cast<std::size_t>(cells.size()));
    for_each_cell(placed.size(), run, "receivers",
                  [&](std::size_t n) { placed[n] = placed_in(package, cells.cell_at(n), city, surfaces, rows, run.stop); });
    for (const auto& of_cell : placed)
      for (const Placed& p : of_cell) ++ends_[p.row + 1];
    for (std::size_t n = 1; n < ends_.size(); ++n) ends_[n] += ends_[n - 1];
    receivers_.resize(ends_.back());
    for (const auto& of_cell : placed)
      for (const Placed& p : of_cell) receivers_[ends_[p.row]++] = p.receiver;
  }
  [[nodiscard]] std::span<const ReceiverInScene> of(std::size_t row) const {
    const std::size_t begin = row == 0 ? 0 : ends_[row - 1];
    return std::span(receivers_).subspan(begin, ends_[row] - begin);
  }

 private:
  struct Placed {
    std::uint32_t row = 0;
    ReceiverInScene receiver;
  };
  static std::vector<Placed> placed_in(const PackageReader& package, Cell cell, const WholeCity& city,
                                       const SurfaceSettings& surfaces, const SurfaceRows& rows, const std::stop_token& stop) {
    std::vector<Placed> placed;
    const BlockTiles& block = package.block_tiles(cell);
    const TileView tile = package.tile(cell);
    for (const SurfaceReceiver& r : surface_receivers(package, cell, surfaces.choice, surfaces.spacing_m, stop)) {
      if (r.is_inside_building) continue;
      const package::SurfaceRecord& surface = tile.surface_of(r.triangle);
      const auto row = rows.find(block.id_of(block.buildings()[surface.building]), surface.number);
      if (row) placed.push_back({*row, {city.scene_from_cell(r.p_cell, cell), r.normal, r.area_m2}});
    }
    return placed;
  }

  std::vector<std::size_t> ends_;
  std::vector<ReceiverInScene> receivers_;
};

std::vector<FoundRow> found_rows(std::size_t count, const ReceiversOfRows& receivers, const SceneOfColumns& scene,
                                 const SkyDirections& directions, const RunSettings& run) {
  std::vector<FoundRow> rows(count);
  oneapi::tbb::enumerable_thread_specific<ColumnSums> sums(std::size_t{scene.columns.count()});
  // A surface is a piece of work, as a cell is
  for_each_cell(count, run, "view factors", [&](std::size_t n) {
    FoundRow& row = rows[n];
    row.receivers = receivers.of(n).size();
    for (const ReceiverInScene& r : receivers.of(n)) row.area_m2 += static_cast<double>(r.area_m2);
    row.shares = views_of(receivers.of(n), scene, directions, sums.local(), run.stop);
  });
  return rows;
}

void add_row(std::vector<ViewShare> row, double threshold, ViewFactorMatrix& matrix) {
  const std::size_t first_of_rest = matrix.surfaces + matrix.ground.size();
  if (row.empty()) row.push_back({static_cast<std::uint32_t>(matrix.column_of(MatrixRest::other)), 1.0F});
  double dropped = 0.0;
  const auto add = [&matrix](std::uint32_t column, float value) {
    matrix.columns.push_back(column);
    matrix.values.push_back(value);
  };
  for (const ViewShare& s : row) {
    const auto share = static_cast<double>(s.share);
    if (s.column < first_of_rest && share < threshold)
      dropped += share;
    else
      add(s.column, s.share);
  }
  if (dropped > 0.0) add(static_cast<std::uint32_t>(matrix.column_of(MatrixRest::dropped)), static_cast<float>(dropped));
  matrix.row_end.push_back(matrix.values.size());
  matrix.figures.dropped_max = std::max(matrix.figures.dropped_max, dropped);
  matrix.figures.dropped_mean += dropped / static_cast<double>(matrix.surfaces);
}

/// Puts rows into the matrix, which are no longer needed then.
void add_rows(std::vector<FoundRow> found, double threshold, ViewFactorMatrix& matrix) {
  ReciprocalRows rows(found);
  for (std::size_t n = 0; n < found.size(); ++n) {
    matrix.area_m2.push_back(found[n].area_m2);
    add_row(rows.row(n), threshold, matrix);
    std::vector<ViewShare>().swap(found[n].shares);
  }
  const double dropped_mean = matrix.figures.dropped_mean, dropped_max = matrix.figures.dropped_max;
  matrix.figures = rows.figures();
  matrix.figures.dropped_mean = dropped_mean;
  matrix.figures.dropped_max = dropped_max;
}

ViewFactorMatrix without_rows(const PackageReader& package, std::size_t surfaces) {
  const package::Manifest& m = package.manifest();
  ViewFactorMatrix matrix;
  matrix.surfaces = surfaces;
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.grid.cells.size()); ++n) {
    const Cell cell = m.grid.cells.cell_at(n);
    const Point2d centre = m.grid.centre_of(cell);
    matrix.ground.push_back({{cell.i, cell.j}, horizontal(m.projected_from_grid({centre.x, centre.y, 0.0}))});
  }
  return matrix;
}

ResolvedSettings checked(const SurfaceSettings& surfaces, const MatrixSettings& matrix, const EvaluationSettings& evaluation,
                         const RunSettings& run) {
  if (evaluation.weight != SkyWeight::cosine)
    throw InvalidArgument("weight is solid_angle, and view factors between surfaces are weighted by the cosine: choose that");
  require_one_of("choice", surfaces.choice, SurfaceChoice::all);
  require_between("spacing_m", surfaces.spacing_m, 0.05, 1000.0);
  require_between("threshold", matrix.threshold, 0.0, 1.0);
  EvaluationSettings of_rays;
  of_rays.directions = evaluation.directions;
  of_rays.rays = evaluation.rays;
  // With it, the memory of the scene and its crowns is counted
  of_rays.further = {.view_factors = true, .canopy = evaluation.further.canopy};
  return resolved(of_rays, run);
}

void require_memory_of_matrix(const PackageReader& package, std::span<const SurfaceMean> means,
                              const ResolvedSettings& settings) {
  // Rays of the 20,892 surfaces of a generated city met 76 others and cells each; each entry is held three times in the end
  constexpr double entries_of_row = 250, bytes_of_entry = 3 * sizeof(ViewShare);
  double receivers = 0.0;
  for (const SurfaceMean& mean : means) receivers += static_cast<double>(mean.receivers);
  (void)require_memory(
      package.manifest(), settings,
      {static_cast<double>(means.size()) * entries_of_row * bytes_of_entry + 2.0 * sizeof(ReceiverInScene) * receivers, 0.0,
       true});
}

}  // namespace

ViewFactorMatrix view_factor_matrix(const Package& package, const SurfaceSettings& surfaces, std::span<const SurfaceMean> means,
                                    const MatrixSettings& matrix, const EvaluationSettings& evaluation, const RunSettings& run) {
  const ResolvedSettings settings = checked(surfaces, matrix, evaluation, run);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_memory_of_matrix(reader, means, settings);
  ViewFactorMatrix result = without_rows(reader, means.size());
  const MatrixColumns columns{static_cast<std::uint32_t>(means.size()), static_cast<std::uint32_t>(result.ground.size())};
  const SurfaceRows rows(means);
  const WholeCityOnDemand city(reader, settings.run.stop);
  const SeenColumns seen(reader, rows, columns, settings.run.stop);
  const CrownOccluder* const crowns = reader.has_crowns() ? &city.crowns(settings.sky.further.canopy) : nullptr;
  const SkyDirections directions(SkyWeight::cosine, settings.sky.rays, reader.grid().rotation, settings.sky.directions,
                                 settings.run.stop);
  RunSettings quiet = settings.run;
  quiet.on_progress = nullptr;
  const ReceiversOfRows receivers(reader, city.city(), surfaces, rows, means.size(), quiet);
  add_rows(found_rows(means.size(), receivers, {city.city().occluder(), crowns, seen, columns}, directions, settings.run),
           matrix.threshold, result);
  result.figures.rays = directions.ray_count();
  return result;
}

}  // namespace farlod
