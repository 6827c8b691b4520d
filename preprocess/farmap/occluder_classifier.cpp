// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/occluder_classifier.hpp"

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

/// Limits only spare the exact comparison: they are low than it by more than their own rounding.
constexpr double just_below = 1.0 - 1e-9;

}  // namespace

OccluderClassifier::OccluderClassifier(const CityHorizon& city, const CellPlace& place, const ViewpointHorizons& views,
                                       const BinBorders& borders, double tolerance, BakedHorizon& map)
    : city_(city),
      place_(place),
      views_(views),
      bins_(borders.bins()),
      tolerance_(tolerance),
      map_(map),
      seen_(map.high.size()),
      limits_(map.high.size()),
      grounded_(map.high.size()),
      edge_(borders) {
  for (std::uint32_t patch = 0; patch < place_.patches.count(); ++patch) see_from(patch);
}

/// The lowest horizon of the patch's four high corners.
void OccluderClassifier::see_from(std::uint32_t patch) {
  const std::uint32_t n = place_.patches.squares_per_edge(), square = patch % place_.patches.squares(),
                      level = place_.ceiling_level(patch / place_.patches.squares());
  const std::uint32_t i = square % n, j = square / n;
  for (std::uint32_t bin = 0; bin < bins_.count; ++bin) {
    float lowest = views_.slope(i, j, level, bin);
    for (const auto& [di, dj] : {std::pair{1U, 0U}, std::pair{0U, 1U}, std::pair{1U, 1U}})
      lowest = std::min(lowest, views_.slope(i + di, j + dj, level, bin));
    const std::size_t place = std::size_t{patch} * bins_.count + bin;
    seen_[place] = lowest;
    limits_[place] = std::max<double>(lowest, just_below * slope_of_sine(sine_of_slope(lowest) + tolerance_));
  }
}

std::uint32_t OccluderClassifier::judge(std::uint32_t number) {
  const OccluderEdge& occluder = city_.occluders()[number];
  package::ExplicitOccluder entry{number, 0, 0};
  for (std::uint32_t square = 0; square < place_.patches.squares(); ++square) {
    const PatchBox box = place_.patches.box(square);
    const OccluderEdge placed = occluder.from(place_.corner);
    edge_.look_at(placed.a, placed.b, {box.low, box.high});
    for (std::uint32_t layer = 0; layer < place_.patches.layers(); ++layer) {
      // What does not rise above the floor hides nothing there
      if (occluder.z_high_m() <= place_.patches.levels_m()[layer]) break;
      const std::uint32_t patch = place_.patches.number(square, layer);
      if (edge_.surrounds() || matters(patch, occluder.role)) {
        entry.squares = static_cast<std::uint16_t>(entry.squares | (1U << square));
        entry.layers = static_cast<std::uint16_t>(entry.layers | (1U << layer));
      } else {
        add_to_residual(patch, occluder.role);
      }
    }
  }
  if (entry.squares != 0) map_.explicit_edges.push_back(entry);
  return entry.layers;
}

/// Whether the edge at hand can rise significantly above what is seen anyway, by an amount that its bounds do not decide.
bool OccluderClassifier::matters(std::uint32_t patch, EdgeRole role) {
  const std::uint32_t layer = patch / place_.patches.squares();
  const std::size_t row = std::size_t{patch} * bins_.count;
  const std::span<const double> high = edge_.high(place_.patches.levels_m()[layer]);
  const std::span<const double> low = edge_.low(place_.patches.ceiling_m(layer));
  bool matters = false;
  for_each_bin(bins_, edge_.first_bin(), high.size(), [&](std::size_t n, std::uint32_t bin) {
    if (matters || high[n] <= limits_[row + bin]) return;
    // A lower border bounds nothing: what is below it is open
    const double hidden = role == EdgeRole::underside ? 0.0 : low[n];
    const double least = std::max(static_cast<double>(seen_[row + bin]), hidden);
    matters = high[n] > least && sine_of_slope(high[n]) - sine_of_slope(least) > tolerance_;
  });
  return matters;
}

void OccluderClassifier::add_to_residual(std::uint32_t patch, EdgeRole role) {
  const std::uint32_t layer = patch / place_.patches.squares();
  const std::size_t row = std::size_t{patch} * bins_.count;
  const auto raise = [&](std::vector<float>& rows, std::span<const double> slopes) {
    for_each_bin(bins_, edge_.first_bin(), slopes.size(), [&](std::size_t n, std::uint32_t bin) {
      rows[row + bin] = std::max(rows[row + bin], static_cast<float>(slopes[n]));
    });
  };
  if (role == EdgeRole::underside) return raise(map_.overhang, edge_.high(place_.patches.levels_m()[layer]));
  raise(map_.high, edge_.high(place_.patches.levels_m()[layer]));
  raise(map_.low, edge_.low(place_.patches.ceiling_m(layer)));
  if (role == EdgeRole::grounded) raise(grounded_, edge_.low(place_.patches.ceiling_m(layer)));
}

void OccluderClassifier::drop_hidden_overhangs() {
  for (std::size_t n = 0; n < grounded_.size(); ++n)
    if (map_.overhang[n] <= grounded_[n]) map_.overhang[n] = 0.0F;
}

}  // namespace farlod
