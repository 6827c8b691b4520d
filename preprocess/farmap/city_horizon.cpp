// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/city_horizon.hpp"

#include <algorithm>
#include <limits>

namespace farlod {
namespace {

std::size_t occluder_count(const TileSet& tiles) {
  std::size_t count = 0;
  for (const Tile& tile : tiles.tiles) count += tile.horizon_edges.size();
  return count;
}

}  // namespace

CityHorizon::CityHorizon(const TileSet& tiles, const Grid& grid)
    : grid_(grid), origin_grid_(grid.middle_corner()), cells_(tiles.cells) {
  occluders_.reserve(occluder_count(tiles));
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    first_of_cell_.push_back(static_cast<std::uint32_t>(occluders_.size()));
    gather(tiles.tiles[n], cells_.cell_at(n));
  }
  first_of_cell_.push_back(static_cast<std::uint32_t>(occluders_.size()));
  if (occluders_.empty()) return;
  nodes_.emplace_back();
  build(0, cells_);
}

void CityHorizon::gather(const Tile& tile, Cell cell) {
  const Point2d corner = corner_of(cell);
  const auto placed = [corner](const Point3f& p) { return Point3d{corner.x + p.x, corner.y + p.y, p.z}; };
  for (const HorizonEdge& e : tile.horizon_edges) occluders_.push_back({placed(e.a), placed(e.b), e.adjacent, e.role});
}

void CityHorizon::build(std::uint32_t n, const CellRange& range) {
  Node node;
  node.z_high_m = node.z_underside_m = -std::numeric_limits<double>::infinity();
  if (range.size() == 1) {
    node.cell = {range.i_begin, range.j_begin};
    // A leaf is a cell: its box is that of its occluders
    const std::size_t index = cells_.index_of(node.cell);
    node.first_occluder = first_of_cell_[index];
    node.occluder_count = first_of_cell_[index + 1] - first_of_cell_[index];
    for (const OccluderEdge& o : occluders().subspan(node.first_occluder, node.occluder_count)) {
      node.z_high_m = std::max(node.z_high_m, o.z_high_m());
      if (!o.is_upper()) node.z_underside_m = std::max(node.z_underside_m, o.z_high_m());
      for (const Point3d& p : {o.a, o.b}) node.outline.add(horizontal(p));
    }
    nodes_[n] = node;
    return;
  }
  // Halve the longer side of the rectangle
  CellRange low = range, high = range;
  if (range.width() >= range.height()) {
    low.i_end = high.i_begin = range.i_begin + static_cast<std::int32_t>(range.width() / 2);
  } else {
    low.j_end = high.j_begin = range.j_begin + static_cast<std::int32_t>(range.height() / 2);
  }
  // Siblings stand side by side
  node.children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  build(node.children, low);
  build(node.children + 1, high);
  // The box of a node encloses those of its children
  for (const Node& child : {nodes_[node.children], nodes_[node.children + 1]}) {
    node.z_high_m = std::max(node.z_high_m, child.z_high_m);
    node.z_underside_m = std::max(node.z_underside_m, child.z_underside_m);
    if (child.outline.empty()) continue;
    node.outline.add(child.outline.low);
    node.outline.add(child.outline.high);
  }
  nodes_[n] = node;
}

}  // namespace farlod
