// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "farlod/word.hpp"

namespace farlod {

/// How much of the sky's light passes crowns. ψ is the transmissivity of a crown.
enum class CanopyRule : std::uint8_t {
  once,  ///< ψ in each direction that meets a crown, however many it meets: the rule of UMEP. Of several ψ the smallest counts
  each,  ///< the product of the ψ of all crowns that a direction meets
  beer   ///< exp(−Σ κ l), with the length l in metres within each crown: the law of Beer and Lambert
};
inline constexpr std::array<Word<CanopyRule>, 3> canopy_rule_words{
    {{"umep", CanopyRule::once}, {"crowns", CanopyRule::each}, {"beer", CanopyRule::beer}}};

enum class Season : std::uint8_t { leaf_on, leaf_off };

/// Light that crowns let through in leaf and without leaves: Konarska et al. 2014 measured 1.3 to 5.3 % and 40 to 52 %.
inline constexpr double leaf_on_transmissivity = 0.03, leaf_off_transmissivity = 0.5;
/// κ in 1/m: an extinction coefficient of 0.6, and a square metre of leaves in a cubic metre.
inline constexpr double leaf_on_extinction_per_m = 0.6;

/// What crowns do to the sky in a run.
struct CanopySettings {
  CanopyRule rule = CanopyRule::once;
  /// Evergreen crowns are always in leaf; all others are bare in the season leaf_off.
  Season season = Season::leaf_on;
  /// ψ of the crowns of the season, 0 to 1, instead of the constants above. Evergreen crowns in the season leaf_off keep
  /// leaf_on_transmissivity.
  std::optional<double> transmissivity = {};
  /// κ of crowns in leaf, above 0. Bare ones have so much less that a length that lets leaf_on_transmissivity through in summer
  /// lets leaf_off_transmissivity through in winter.
  double extinction_per_m = leaf_on_extinction_per_m;

  bool operator==(const CanopySettings&) const = default;
};

}  // namespace farlod
