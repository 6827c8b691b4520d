// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/occluder_classifier.hpp"

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

/// The threshold spares the exact comparison, and must not decide it: it is lower by more than its own rounding.
constexpr double just_below = 1.0 - 1e-9;

}  // namespace

OccluderClassifier::OccluderClassifier(const CityHorizon& city, const ReceiverCell& cell, const ViewpointHorizons& viewpoints,
                                       const BinBorders& borders, double tolerance, BakedHorizon& map)
    : city_(city),
      cell_(cell),
      viewpoints_(viewpoints),
      bins_(borders.bins()),
      tolerance_(tolerance),
      map_(map),
      lowest_horizon_(map.high.size()),
      significant_above_(map.high.size()),
      grounded_low_(map.high.size()),
      edge_(borders) {
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

}  // namespace farlod
