// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/seen_columns.hpp"

#include "base/cancellation.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod {

SurfaceRows::SurfaceRows(std::span<const SurfaceMean> means) {
  for (const SurfaceMean& mean : means)
    rows_.emplace(std::pair(std::string_view(mean.building), mean.surface), static_cast<std::uint32_t>(rows_.size()));
}

std::optional<std::uint32_t> SurfaceRows::find(std::string_view building, std::uint32_t surface) const {
  const auto row = rows_.find({building, surface});
  return row == rows_.end() ? std::nullopt : std::optional(row->second);
}

SeenColumns::SeenColumns(const PackageReader& package, const SurfaceRows& rows, const MatrixColumns& columns,
                         const std::stop_token& stop)
    : other_(columns.rest(MatrixRest::other)) {
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    throw_if_cancelled(stop);
    const BlockTiles& block = package.block_tiles(cells.cell_at(n));
    const TileView tile = package.tile(cells.cell_at(n));
    std::uint32_t begin = 0;
    for (const package::SurfaceRun& run : tile.surface_runs) {
      const package::SurfaceRecord& surface = tile.surfaces[run.surface];
      if (surface.kind() == SurfaceKind::ground)
        add(run.end - begin, {{}, columns.ground(n)});
      else
        add(run.end - begin, {surface.normal().direction(),
                              rows.find(block.id_of(block.buildings()[surface.building]), surface.number).value_or(other_)});
      begin = run.end;
    }
  }
  add(package.far_terrain().triangles.size(), {{}, columns.rest(MatrixRest::ground_beyond)});
}

void SeenColumns::add(std::size_t triangles, const Front& front) {
  front_of_triangle_.insert(front_of_triangle_.end(), triangles, static_cast<std::uint32_t>(fronts_.size()));
  fronts_.push_back(front);
}

}  // namespace farlod
