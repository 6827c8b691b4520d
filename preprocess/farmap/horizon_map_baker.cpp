// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/horizon_map_baker.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "farmap/edge_over_square.hpp"
#include "farmap/occlusion_culler.hpp"

namespace farlod {
namespace {

/// Decides for each patch of a cell which candidates are explicit, and bounds the others.
class OccluderClassifier {
 public:
  /// All must outlive it; `map` gets the explicit occluders and the bounds.
  OccluderClassifier(const CityHorizon& city, const ReceiverCell& cell, const ViewpointHorizons& viewpoints,
                     const BinBorders& borders, const HorizonMapSettings& settings, BakedHorizon& map);

  /// Makes an occluder (by its number in the city) explicit for the patches where it is significant, and bounds it for the
  /// others. Returns the layers in which it is explicit, as bits.
  std::uint32_t classify(std::uint32_t number);
  /// No sky is seen below a lower border that grounded edges hide for certain: takes such ones out of the map. To be called last.
  void drop_hidden_overhangs();

 private:
  void set_thresholds(std::uint32_t patch);
  [[nodiscard]] bool is_significant(std::uint32_t patch, EdgeRole role);
  void add_to_residual(std::uint32_t patch, EdgeRole role);

  const CityHorizon& city_;
  const ReceiverCell& cell_;
  const ViewpointHorizons& viewpoints_;
  const AzimuthBins& bins_;
  double tolerance_of_city_, tolerance_of_far_terrain_;
  double tolerance_ = 0.0;  ///< of the current occluder; at first the smaller one of those that there are
  BakedHorizon& map_;
  std::vector<float> lowest_horizon_;      ///< rows as in the map: the lowest horizon that the patch's viewpoints see
  std::vector<double> significant_above_;  ///< likewise: no edge below this slope is significant
  std::vector<float> grounded_low_;        ///< likewise: residual grounded edges hide everything below it for certain
  EdgeOverSquare edge_;                    ///< the current occluder, seen from all over a square
};

/// The threshold spares the exact comparison, and must not decide it: it is lower by more than its own rounding.
constexpr double just_below = 1.0 - 1e-9;

OccluderClassifier::OccluderClassifier(const CityHorizon& city, const ReceiverCell& cell, const ViewpointHorizons& viewpoints,
                                       const BinBorders& borders, const HorizonMapSettings& settings, BakedHorizon& map)
    : city_(city),
      cell_(cell),
      viewpoints_(viewpoints),
      bins_(borders.bins()),
      tolerance_of_city_(settings.tolerance),
      tolerance_of_far_terrain_(std::min(settings.far_terrain_tolerance, settings.tolerance)),
      map_(map),
      lowest_horizon_(map.high.size()),
      significant_above_(map.high.size()),
      grounded_low_(map.high.size()),
      edge_(borders) {
  tolerance_ = city.has_far_terrain() ? tolerance_of_far_terrain_ : tolerance_of_city_;
  for (std::uint32_t patch = 0; patch < cell_.patches.count(); ++patch) set_thresholds(patch);
}

/// Finds the lowest horizon of the patch's four viewpoints at its ceiling, and the slopes that exceed it by the tolerance.
void OccluderClassifier::set_thresholds(std::uint32_t patch) {
  const std::uint32_t n = cell_.patches.squares_per_edge(), square = patch % cell_.patches.squares(),
                      level = cell_.ceiling_level(patch / cell_.patches.squares());
  const std::uint32_t i = square % n, j = square / n;
  for (std::uint32_t bin = 0; bin < bins_.count; ++bin) {
    float lowest = viewpoints_.slope(i, j, level, bin);
    for (const auto& [di, dj] : {std::pair{1U, 0U}, std::pair{0U, 1U}, std::pair{1U, 1U}})
      lowest = std::min(lowest, viewpoints_.slope(i + di, j + dj, level, bin));
    const std::size_t index = std::size_t{patch} * bins_.count + bin;
    lowest_horizon_[index] = lowest;
    significant_above_[index] = std::max<double>(lowest, just_below * slope_of_sine(sine_of_slope(lowest) + tolerance_));
  }
}

std::uint32_t OccluderClassifier::classify(std::uint32_t number) {
  const OccluderEdge& occluder = city_.occluders()[number];
  const OccluderEdge placed = occluder.from(cell_.corner);
  tolerance_ = city_.is_far_terrain(number) ? tolerance_of_far_terrain_ : tolerance_of_city_;
  package::ExplicitOccluder explicit_in{number, 0, 0};
  for (std::uint32_t square = 0; square < cell_.patches.squares(); ++square) {
    const PatchBox box = cell_.patches.box(square);
    edge_.set_edge(placed.a, placed.b, {box.low, box.high});
    for (std::uint32_t layer = 0; layer < cell_.patches.layers(); ++layer) {
      // What does not rise above the floor hides nothing there, nor in the layers above
      if (occluder.z_high_m() <= cell_.patches.levels_m()[layer]) break;
      const std::uint32_t patch = cell_.patches.number(square, layer);
      if (edge_.is_unbounded() || is_significant(patch, occluder.role)) {
        explicit_in.squares = static_cast<std::uint16_t>(explicit_in.squares | (1U << square));
        explicit_in.layers = static_cast<std::uint16_t>(explicit_in.layers | (1U << layer));
      } else {
        add_to_residual(patch, occluder.role);
      }
    }
  }
  if (explicit_in.squares != 0) map_.explicit_edges.push_back(explicit_in);
  return explicit_in.layers;
}

/// Whether the current edge can rise by more than the tolerance over what hides the sky anyway: the lowest horizon of the
/// viewpoints, or the edge's own lower bound.
bool OccluderClassifier::is_significant(std::uint32_t patch, EdgeRole role) {
  const std::uint32_t layer = patch / cell_.patches.squares();
  const std::size_t row = std::size_t{patch} * bins_.count;
  const std::span<const double> high = edge_.high(cell_.patches.levels_m()[layer]);
  const std::span<const double> low = edge_.low(cell_.patches.ceiling_m(layer));
  bool significant = false;
  for_each_bin(bins_, edge_.first_bin(), high.size(), [&](std::size_t n, std::uint32_t bin) {
    if (significant || high[n] <= significant_above_[row + bin]) return;
    // A lower border hides nothing: what is below it is open
    const double hidden = role == EdgeRole::underside ? 0.0 : low[n];
    const double hidden_anyway = std::max(static_cast<double>(lowest_horizon_[row + bin]), hidden);
    significant = high[n] > hidden_anyway && sine_of_slope(high[n]) - sine_of_slope(hidden_anyway) > tolerance_;
  });
  return significant;
}

/// Raises the bounds of a patch by those of the current edge.
void OccluderClassifier::add_to_residual(std::uint32_t patch, EdgeRole role) {
  const std::uint32_t layer = patch / cell_.patches.squares();
  const std::size_t row = std::size_t{patch} * bins_.count;
  const auto raise = [&](std::vector<float>& rows, std::span<const double> slopes) {
    for_each_bin(bins_, edge_.first_bin(), slopes.size(), [&](std::size_t n, std::uint32_t bin) {
      rows[row + bin] = std::max(rows[row + bin], static_cast<float>(slopes[n]));
    });
  };
  // An edge is seen steepest from the floor of the patch, and flattest from its ceiling
  if (role == EdgeRole::underside) return raise(map_.overhang, edge_.high(cell_.patches.levels_m()[layer]));
  raise(map_.high, edge_.high(cell_.patches.levels_m()[layer]));
  raise(map_.low, edge_.low(cell_.patches.ceiling_m(layer)));
  if (role == EdgeRole::grounded) raise(grounded_low_, edge_.low(cell_.patches.ceiling_m(layer)));
}

void OccluderClassifier::drop_hidden_overhangs() {
  for (std::size_t n = 0; n < grounded_low_.size(); ++n)
    if (map_.overhang[n] <= grounded_low_[n]) map_.overhang[n] = 0.0F;
}

/// Heads rise this much above the highest ground of a cell: receivers at 1.5 m stand in the lowest layer.
constexpr float street_layer_m = 2.0F;
/// Roofs bear receivers too, a little above them.
constexpr float above_roofs_m = 0.5F;

/// The floors of a cell's layers. The street is the first layer; the others reach up to the highest roof. Their floors are spaced
/// quadratically: finer below, where most roofs are.
std::vector<float> levels_of(const Tile& tile, std::span<const Surface> surfaces, std::uint32_t layers) {
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

/// A map without explicit occluders, whose upper bounds are those of what is hidden. These hold all over the cell: for each
/// square alike.
BakedHorizon map_of_culled(const ReceiverPatches& patches, const CullResult& culled) {
  const std::size_t bins = culled.high.size() / patches.layers();
  BakedHorizon map{patches, {}, std::vector<float>(patches.count() * bins, 0.0F), {}, {}, {}};
  map.estimate = map.low;
  for (std::uint32_t patch = 0; patch < patches.count(); ++patch) {
    const auto begin = static_cast<std::ptrdiff_t>(patch / patches.squares() * bins);
    const auto end = begin + static_cast<std::ptrdiff_t>(bins);
    map.high.insert(map.high.end(), culled.high.begin() + begin, culled.high.begin() + end);
    map.overhang.insert(map.overhang.end(), culled.overhang.begin() + begin, culled.overhang.begin() + end);
  }
  return map;
}

/// The estimate of a patch: the average horizon of the viewpoints at the four corners of its floor.
void estimate(const ViewpointHorizons& viewpoints, BakedHorizon& map) {
  const std::uint32_t n = map.patches.squares_per_edge();
  const auto bins = static_cast<std::uint32_t>(map.estimate.size() / map.patches.count());
  for (std::uint32_t patch = 0; patch < map.patches.count(); ++patch) {
    const std::uint32_t square = patch % map.patches.squares(), layer = patch / map.patches.squares();
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
      float sum = 0.0F;
      for (std::uint32_t corner = 0; corner < 4; ++corner)
        sum += viewpoints.slope(square % n + (corner & 1U), square / n + (corner >> 1U), layer, bin);
      map.estimate[patch * bins + bin] = 0.25F * sum;
    }
  }
}

/// Gathers the explicit occluders of a block's cells, each once, and numbers them anew.
class BlockOccluders {
 public:
  /// `corner` is the block's, in the frame of the city, which must outlive this.
  BlockOccluders(const CityHorizon& city, Point2d corner) : city_(city), corner_(corner) {}

  /// From numbers in the city to rows of `edges`.
  void renumber(std::vector<package::ExplicitOccluder>& occluders) {
    for (package::ExplicitOccluder& n : occluders) n.row = row_of(n.row);
  }
  std::vector<HorizonEdge> edges;

 private:
  [[nodiscard]] std::uint32_t row_of(std::uint32_t number) {
    const OccluderEdge& o = city_.occluders()[number];
    const auto [entry, is_new] = rows_.try_emplace(number, static_cast<std::uint32_t>(edges.size()));
    if (is_new) edges.push_back({placed(o.a), placed(o.b), o.adjacent, o.role});
    return entry->second;
  }
  [[nodiscard]] Point3f placed(const Point3d& p) const {
    return {static_cast<float>(p.x - corner_.x), static_cast<float>(p.y - corner_.y), static_cast<float>(p.z)};
  }

  const CityHorizon& city_;
  Point2d corner_;
  std::unordered_map<std::uint32_t, std::uint32_t> rows_;
};

}  // namespace

HorizonMapBaker::HorizonMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings)
    : HorizonMapBaker(tiles, grid, settings, CityHorizon(tiles, grid)) {}

HorizonMapBaker::HorizonMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, CityHorizon city)
    : tiles_(tiles), grid_(grid), settings_(settings), city_(std::move(city)), borders_({settings.azimuth_bins}) {
  // Squares and layers must fit the bits of package::ExplicitOccluder; the street and the roofs are two layers
  FARLOD_EXPECTS(settings.squares_per_edge >= 1 && settings.squares_per_edge <= 4 && settings.layers >= 2 &&
                 settings.layers <= package::most_layers);
}

BakedHorizons HorizonMapBaker::bake(Block block, const std::stop_token& stop) const {
  const CellRange range = grid_.cells_of(block);
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) cells.push_back(range.cell_at(n));
  return bake(cells, stop);
}

BakedHorizons HorizonMapBaker::bake(std::span<const Cell> cells, const std::stop_token& stop) const {
  FARLOD_EXPECTS(!cells.empty());
  return bake(cells, cells.front(), stop);
}

BakedHorizons HorizonMapBaker::bake(std::span<const Cell> cells, Cell frame, const std::stop_token& stop) const {
  FARLOD_EXPECTS(!cells.empty());
  std::vector<std::optional<BakedHorizon>> baked(cells.size());
  // Blocks may be baked at the same time: what ends another one must not leave this one half done
  oneapi::tbb::task_group_context of_its_own(oneapi::tbb::task_group_context::isolated);
  const auto bake_one = [&](std::size_t n) {
    throw_if_cancelled(stop);
    baked[n] = bake_cell(cells[n]);
  };
  oneapi::tbb::parallel_for(std::size_t{0}, baked.size(), bake_one, of_its_own);
  BlockOccluders occluders(city_, city_.corner_of(frame));
  BakedHorizons result;
  for (std::optional<BakedHorizon>& cell : baked) {
    occluders.renumber(cell->explicit_edges);
    result.cells.push_back(std::move(*cell));
  }
  result.edges = std::move(occluders.edges);
  return result;
}

BakedHorizon HorizonMapBaker::bake_cell(Cell cell) const {
  const ReceiverCell receivers{
      city_.corner_of(cell),
      grid_.neighborhood_of(cell),
      {{0.0, 0.0}, {grid_.cell_edge_m, grid_.cell_edge_m}},
      {grid_.cell_edge_m, settings_.squares_per_edge, levels_of(tiles_.tile(cell), tiles_.surfaces, settings_.layers)}};
  // Cull what the nearer city hides, and bound it
  const CullResult culled = OcclusionCuller(city_, receivers, borders_, settings_).run();
  BakedHorizon map = map_of_culled(receivers.patches, culled);
  // Make the significant candidates explicit, and bound the others
  OccluderClassifier classifier(city_, receivers, culled.viewpoints, borders_, settings_, map);
  // Draw the horizon of the residual city: candidates at the levels where they are not explicit, and all that is weak
  ViewpointHorizons residual(grid_.cell_edge_m, receivers.patches, borders_);
  const auto add_to_residual = [&](std::uint32_t number, std::uint32_t levels) {
    const OccluderEdge occluder = city_.occluders()[number].from(receivers.corner);
    if (occluder.is_upper()) residual.add(occluder.a, occluder.b, levels);
  };
  for (const std::uint32_t number : culled.candidates) add_to_residual(number, ~classifier.classify(number));
  for (const std::uint32_t number : culled.weak) add_to_residual(number, ViewpointHorizons::all_levels);
  // Two bounds that are equal may have been rounded past each other
  for (std::size_t n = 0; n < map.low.size(); ++n) map.low[n] = std::min(map.low[n], map.high[n]);
  classifier.drop_hidden_overhangs();
  estimate(residual, map);
  return map;
}

}  // namespace farlod
