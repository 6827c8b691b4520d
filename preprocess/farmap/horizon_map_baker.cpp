// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/horizon_map_baker.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "farlod/expects.hpp"
#include "farmap/block_occluders.hpp"
#include "farmap/occluder_classifier.hpp"
#include "farmap/occlusion_culler.hpp"

namespace farlod {
namespace {

/// Heads rise this much above the highest ground of a cell: receivers at 1.5 m stand in the lowest layer.
constexpr float street_layer_m = 2.0F;
/// Roofs bear receivers too, a little above them.
constexpr float above_roofs_m = 0.5F;

/// Levels of a cell's layers: the street first, then up to the highest roof, finer below, where most roofs are.
std::vector<float> levels_of(const Tile& tile, const std::vector<Surface>& surfaces, std::uint32_t layers) {
  float ground_low = tile.ground_at_centre_m, ground_high = tile.ground_at_centre_m;
  for (std::size_t n = 0; n < tile.triangles.size(); ++n) {
    if (surfaces[tile.triangle_surfaces[n]].building != ground_building) continue;
    for (const std::uint32_t v : {tile.triangles[n].a, tile.triangles[n].b, tile.triangles[n].c}) {
      ground_low = std::min(ground_low, tile.vertices[v].z);
      ground_high = std::max(ground_high, tile.vertices[v].z);
    }
  }
  std::vector<float> levels{ground_low, ground_high + street_layer_m};
  const float top = std::max(levels.back(), tile.z_high_m + above_roofs_m);
  for (std::uint32_t l = 2; l < layers; ++l) {
    const float share = static_cast<float>(l - 1) / static_cast<float>(layers - 2);
    levels.push_back(levels[1] + (top - levels[1]) * share * share);
  }
  return levels;
}

/// A map that names nothing, above what was hidden at first sight. That holds from all over the cell: for each square alike.
BakedHorizon empty_map(const ReceiverPatches& patches, const CullResult& around) {
  const std::size_t bins = around.hidden.size() / patches.layers();
  BakedHorizon map{patches, {}, std::vector<float>(patches.count() * bins, 0.0F), {}, {}, {}};
  map.estimate = map.low;
  for (std::uint32_t patch = 0; patch < patches.count(); ++patch) {
    const auto begin = static_cast<std::ptrdiff_t>(patch / patches.squares() * bins);
    const auto end = begin + static_cast<std::ptrdiff_t>(bins);
    map.high.insert(map.high.end(), around.hidden.begin() + begin, around.hidden.begin() + end);
    map.overhang.insert(map.overhang.end(), around.overhang.begin() + begin, around.overhang.begin() + end);
  }
  return map;
}

/// What the viewpoints at the corners of a patch's floor see on average.
void estimate(const ViewpointHorizons& views, BakedHorizon& map) {
  const std::uint32_t n = map.patches.squares_per_edge();
  const auto bins = static_cast<std::uint32_t>(map.estimate.size() / map.patches.count());
  for (std::uint32_t patch = 0; patch < map.patches.count(); ++patch) {
    const std::uint32_t square = patch % map.patches.squares(), layer = patch / map.patches.squares();
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
      float sum = 0.0F;
      for (std::uint32_t corner = 0; corner < 4; ++corner)
        sum += views.slope(square % n + (corner & 1U), square / n + (corner >> 1U), layer, bin);
      map.estimate[patch * bins + bin] = 0.25F * sum;
    }
  }
}

}  // namespace

HorizonMapBaker::HorizonMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings)
    : tiles_(tiles), grid_(grid), settings_(settings), city_(tiles, grid), borders_({settings.azimuth_bins}) {
  // Squares and layers must fit the bits of package::ExplicitOccluder; the street and the roofs are two layers
  FARLOD_EXPECTS(settings.squares_per_edge >= 1 && settings.squares_per_edge <= 4 && settings.layers >= 2 &&
                 settings.layers <= package::most_layers);
}

BakedHorizons HorizonMapBaker::bake(Block block) const {
  const CellRange range = grid_.cells_of(block);
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return bake(cells);
}

BakedHorizons HorizonMapBaker::bake(std::span<const Cell> cells) const {
  std::vector<std::optional<BakedHorizon>> baked(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, baked.size(), [&](std::size_t n) { baked[n] = bake_cell(cells[n]); });
  BlockOccluders occluders(city_, city_.corner_of(cells.front()));
  BakedHorizons result;
  for (std::optional<BakedHorizon>& cell : baked) {
    occluders.renumber(cell->explicit_edges);
    result.cells.push_back(std::move(*cell));
  }
  result.edges = std::move(occluders.edges);
  return result;
}

BakedHorizon HorizonMapBaker::bake_cell(Cell cell) const {
  const CellPlace place{
      city_.corner_of(cell),
      grid_.neighborhood_of(cell),
      {{0.0, 0.0}, {grid_.cell_edge_m, grid_.cell_edge_m}},
      {grid_.cell_edge_m, settings_.squares_per_edge, levels_of(tiles_.tile(cell), tiles_.surfaces, settings_.layers)}};
  const CullResult around = OcclusionCuller(city_, place, borders_, settings_).run();
  BakedHorizon map = empty_map(place.patches, around);
  OccluderClassifier judge(city_, place, around.views, borders_, settings_.tolerance, map);
  ViewpointHorizons residual(grid_.cell_edge_m, place.patches, borders_);
  const auto add_to_residual = [&](std::uint32_t number, std::uint32_t levels) {
    const OccluderEdge occluder = city_.occluders()[number].from(place.corner);
    if (occluder.is_upper()) residual.add(occluder.a, occluder.b, levels);
  };
  for (const std::uint32_t number : around.candidates) add_to_residual(number, ~judge.judge(number));
  for (const std::uint32_t number : around.weak) add_to_residual(number, ViewpointHorizons::all_levels);
  // A thing may be at least as high as another is at the most: both are rounded
  for (std::size_t n = 0; n < map.low.size(); ++n) map.low[n] = std::min(map.low[n], map.high[n]);
  judge.drop_hidden_overhangs();
  estimate(residual, map);
  return map;
}

}  // namespace farlod
