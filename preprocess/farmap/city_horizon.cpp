// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/city_horizon.hpp"

#include <limits>
#include <utility>

namespace farlod {
namespace {

/// Fewer would cost more boxes than they spare edges.
constexpr std::uint32_t most_in_leaf = 32;

}  // namespace

CityHorizon::CityHorizon(const TileSet& tiles, const Grid& grid)
    : grid_(grid), origin_grid_(grid.middle_corner()), cells_(tiles.cells) {
  for (std::size_t n = 0; n < tiles.tiles.size(); ++n) {
    first_of_cell_.push_back(static_cast<std::uint32_t>(occluders_.size()));
    gather(tiles.tiles[n], cells_.cell_at(n));
  }
  first_of_cell_.push_back(static_cast<std::uint32_t>(occluders_.size()));
  if (!tiles.far_terrain.horizon_edges.empty()) {
    add_beyond(tiles.far_terrain);
    return;
  }
  if (occluders_.empty()) return;
  nodes_.push_back({});
  build(0, cells_);
}

/// The root divides the city and what lies beyond it.
void CityHorizon::add_beyond(const FarTerrain& far_terrain) {
  const auto first = static_cast<std::uint32_t>(occluders_.size());
  for (const HorizonEdge& e : far_terrain.horizon_edges)
    occluders_.push_back({{e.a.x, e.a.y, e.a.z}, {e.b.x, e.b.y, e.b.z}, e.adjacent, e.role});
  nodes_.resize(3);
  nodes_[0].children = 1;
  build(1, cells_);
  build_in_cell(2, beyond_grid, first, static_cast<std::uint32_t>(occluders_.size()) - first);
  join_children(0);
}

CityHorizon::CityHorizon(const Grid& grid, PagedArray<OccluderEdge> occluders, PagedArray<Node> nodes)
    : grid_(grid),
      origin_grid_(grid.middle_corner()),
      cells_(grid.cells),
      occluders_(std::move(occluders)),
      nodes_(std::move(nodes)) {}

void CityHorizon::let_go() const {
  occluders_.let_go();
  nodes_.let_go();
}

void CityHorizon::gather(const Tile& tile, Cell cell) {
  const Point2d corner = corner_of(cell);
  const auto placed = [corner](const Point3f& p) { return Point3d{corner.x + p.x, corner.y + p.y, p.z}; };
  for (const HorizonEdge& e : tile.horizon_edges) occluders_.push_back({placed(e.a), placed(e.b), e.adjacent, e.role});
}

void CityHorizon::build(std::uint32_t n, const CellRange& range) {
  if (range.size() == 1) {
    const Cell cell{range.i_begin, range.j_begin};
    const std::size_t index = cells_.index_of(cell);
    return build_in_cell(n, cell, first_of_cell_[index], first_of_cell_[index + 1] - first_of_cell_[index]);
  }
  // Halve the longer side of the rectangle
  CellRange low = range, high = range;
  if (range.width() >= range.height()) {
    low.i_end = high.i_begin = range.i_begin + static_cast<std::int32_t>(range.width() / 2);
  } else {
    low.j_end = high.j_begin = range.j_begin + static_cast<std::int32_t>(range.height() / 2);
  }
  // Siblings stand side by side
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[n].children = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, low);
  build(children + 1, high);
  join_children(n);
}

/// Halves the occluders of a cell, as many on either side, until few are left.
void CityHorizon::build_in_cell(std::uint32_t n, Cell cell, std::uint32_t first, std::uint32_t count) {
  nodes_[n] = leaf_of(cell, first, count);
  if (count <= most_in_leaf) return;
  const auto middle = [](const OccluderEdge& o) { return horizontal(o.a) + horizontal(o.b); };
  Box2d middles;
  const auto occluders = std::span<OccluderEdge>(occluders_).subspan(first, count);
  for (const OccluderEdge& o : occluders) middles.add(middle(o));
  const Point2d extent = middles.high - middles.low;
  // What has equal places keeps its order: the same on every machine
  if (extent.x >= extent.y) {
    std::ranges::stable_sort(occluders, {}, [&](const OccluderEdge& o) { return middle(o).x; });
  } else {
    std::ranges::stable_sort(occluders, {}, [&](const OccluderEdge& o) { return middle(o).y; });
  }
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[n].children = children;
  nodes_.resize(nodes_.size() + 2);
  build_in_cell(children, cell, first, count / 2);
  build_in_cell(children + 1, cell, first + count / 2, count - count / 2);
}

CityHorizon::Node CityHorizon::leaf_of(Cell cell, std::uint32_t first, std::uint32_t count) const {
  Node node;
  node.z_high_m = node.z_underside_m = -std::numeric_limits<double>::infinity();
  node.cell = cell;
  node.first_occluder = first;
  node.occluder_count = count;
  for (const OccluderEdge& o : occluders().subspan(first, count)) {
    node.z_high_m = std::max(node.z_high_m, o.z_high_m());
    if (!o.is_upper()) node.z_underside_m = std::max(node.z_underside_m, o.z_high_m());
    for (const Point3d& p : {o.a, o.b}) node.outline.add(horizontal(p));
  }
  return node;
}

/// The box of a node encloses those of its children.
void CityHorizon::join_children(std::uint32_t n) {
  Node& node = nodes_[n];
  node.z_high_m = node.z_underside_m = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t c : {node.children, node.children + 1}) {
    const Node& child = nodes_[c];
    node.z_high_m = std::max(node.z_high_m, child.z_high_m);
    node.z_underside_m = std::max(node.z_underside_m, child.z_underside_m);
    if (child.outline.empty()) continue;
    node.outline.add(child.outline.low);
    node.outline.add(child.outline.high);
  }
}

}  // namespace farlod
