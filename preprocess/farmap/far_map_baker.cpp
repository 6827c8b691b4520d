// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/far_map_baker.hpp"

#include <utility>
#include <vector>

#include "farmap/box_map_baker.hpp"
#include "farmap/horizon_map_baker.hpp"

namespace farlod {

FarMapBaker::FarMapBaker(const TileSet& tiles, const Grid& grid, Assign assign, const FarMapSettings& settings) : grid_(grid) {
  if (settings.kind == FarMapKind::box) {
    box_ = std::make_unique<BoxMapBaker>(tiles, grid, assign, settings.box);
  } else {
    horizon_ = std::make_unique<HorizonMapBaker>(tiles, grid, settings.horizon);
  }
}
FarMapBaker::FarMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, CityHorizon city)
    : grid_(grid), horizon_(std::make_unique<HorizonMapBaker>(tiles, grid, settings, std::move(city))) {}
const CityHorizon* FarMapBaker::horizon() const { return horizon_ ? &horizon_->city() : nullptr; }
FarMapBaker::FarMapBaker(FarMapBaker&&) noexcept = default;
FarMapBaker::~FarMapBaker() = default;

BakedBlock FarMapBaker::bake(Block block, const std::stop_token& stop) const {
  if (box_) return box_->bake(block, stop);
  return horizon_->bake(block, stop);
}

BakedBlock FarMapBaker::bake(Block block, const package::CellRuns& cells, const std::stop_token& stop) const {
  const CellRange range = grid_.cells_of(block);
  std::vector<Cell> chosen;
  for (const std::size_t place : cells.places()) chosen.push_back(range.cell_at(place));
  if (box_) return box_->bake(chosen, stop);
  return horizon_->bake(chosen, {range.i_begin, range.j_begin}, stop);
}

package::FarMapShape shape_of(const FarMapSettings& settings) {
  package::FarMapShape shape;
  if (settings.kind == FarMapKind::box) {
    shape.kind = "box";
    shape.side_columns = settings.box.side_columns;
    shape.rows = settings.box.rows;
    return shape;
  }
  shape.kind = "horizon";
  shape.azimuth_bins = settings.horizon.azimuth_bins;
  shape.squares_per_edge = settings.horizon.squares_per_edge;
  shape.layers = settings.horizon.layers;
  shape.tolerance = settings.horizon.tolerance;
  return shape;
}

}  // namespace farlod
