// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/site_package.hpp"

#include <algorithm>
#include <vector>

namespace farlod::validation {
namespace {

Grid with_neighborhood(Grid grid, int neighborhood) {
  grid.neighborhood = neighborhood;
  return grid;
}

}  // namespace

CutCity cut(const StudiedCity& city, Angle bearing, double cell_edge_m, int block_edge) {
  Report report;
  const Grid grid = scenes::grid_covering(city.city, bearing, cell_edge_m, 1, block_edge);
  return {grid, tiles::cut_into_tiles({city.city, {}}, grid, Assign::clip, std::nullopt, report)};
}

FarMapSettings of_kind(FarMapKind kind) {
  FarMapSettings settings;
  settings.kind = kind;
  return settings;
}

SitePackage::SitePackage(const CutCity& cut, int neighborhood, const FarMapSettings& far_map, const scenes::ChosenCells& only)
    : cost_(scenes::pack_tiles(cut.tiles, with_neighborhood(cut.grid, neighborhood), folder_.path() / "city.farlod", far_map,
                               Assign::clip, only)),
      package_(folder_.path() / "city.farlod") {}

double SitePackage::bytes_a_cell() const {
  return static_cast<double>(cost_.bytes_of_whole_blocks) /
         static_cast<double>(std::max<std::size_t>(1, cost_.cells_of_whole_blocks));
}

SitePackage without_far_maps(const CutCity& cut) { return {cut, 1, of_kind(FarMapKind::box), std::vector<Cell>{}}; }

}  // namespace farlod::validation
