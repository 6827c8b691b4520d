// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "farlod/light.hpp"
#include "horizon/light_kernels.hpp"
#include "radiation/light_of_period.hpp"

namespace farlod {

/// What a table has of each direction. Totals follow, direct and diffuse together: the energy of each month in kWh/m², and the
/// illuminance in lx h.
enum class LightLayer : std::size_t {
  uniform,   ///< a sky of the same radiance everywhere: 1 on a level plane
  overcast,  ///< the CIE's overcast sky: 1 on a level plane
  direct,    ///< kWh/m²
  diffuse,   ///< kWh/m²
  first_total
};

/// What comes from the directions between two knots of an azimuth: along it, and from above.
struct LightPart {
  double along = 0.0, up = 0.0;
};

/// What pairs of layers give a receiver whose normal has been applied.
[[nodiscard]] inline float light_of_layer(const LightPair* pairs, std::size_t layer) {
  return pairs[layer / 2].along[layer % 2] + pairs[layer / 2].up[layer % 2];
}

/// When an interval begins, as ISO 8601 has it without marks that names of columns may not have: `20260621T1000`.
[[nodiscard]] std::string begin_text_of(const LightInterval& interval);

/// The light of a period as one distribution over the sky (D. Robinson and A. Stone, PLEA 2004), integrated for the directions
/// above a slope of each azimuth: then the energy that falls on a receiver is a sum over its horizon, however many hours the
/// period has. Receivers with a normal n get n · ∫ ω L(ω) dω; of ω the parts along the azimuth and up are integrated.
///   (1) level, the sums of all azimuths are the irradiations of the intervals, but for rounding
///   (2) between the knots of the table integrals are interpolated
class LightTable {
 public:
  /// Azimuths are shares of the turn, clockwise from true north; each stands for the same part of it.
  LightTable(const LightOfPeriod& light, std::span<const double> turns);

  static constexpr std::size_t most_pairs = most_light_pairs;
  [[nodiscard]] std::size_t layers() const { return 2 * pairs_; }
  /// Months that have layers: months_by_name.
  [[nodiscard]] std::span<const unsigned> months() const { return months_; }

  static constexpr std::size_t last_knot = last_light_knot;
  /// Where a slope lies: so far on from a knot to the next one.
  struct Place {
    std::size_t knot;
    float part;
  };
  [[nodiscard]] static Place place_of(float slope) {
    const float finite = std::min(slope, 1e6F);
    const float place = static_cast<float>(last_knot) * (finite / (1.0F + finite));
    const std::size_t knot = std::min(static_cast<std::size_t>(place), last_knot - 1);
    return {knot, place - static_cast<float>(knot)};
  }
  /// Adds what comes from above a place of an azimuth to pairs of layers(), for a normal's parts along the azimuth and up.
  void add_above(std::size_t azimuth, Place place, float outward, float upward, LightPair* sums) const {
    add(&even_[place.knot], 1, place.part, outward, upward, sums[0]);
    const std::size_t of_azimuth = pairs_ - 1;
    const LightPair* const here = &values_[(azimuth * (last_knot + 1) + place.knot) * of_azimuth];
    for (std::size_t n = 0; n < of_azimuth; ++n) add(here + n, of_azimuth, place.part, outward, upward, sums[n + 1]);
  }
  /// The uniform sky above a place of any azimuth.
  [[nodiscard]] float uniform_above(Place place, float outward, float upward) const {
    const LightPair &here = even_[place.knot], &above = even_[place.knot + 1];
    constexpr auto layer = static_cast<std::size_t>(LightLayer::uniform);
    return outward * (here.along[layer] + place.part * (above.along[layer] - here.along[layer])) +
           upward * (here.up[layer] + place.part * (above.up[layer] - here.up[layer]));
  }

  /// What sums of all azimuths are made of: even() and pairs() of a LightScene.
  [[nodiscard]] const LightPair* even() const { return even_.data(); }
  [[nodiscard]] const LightPair* pairs() const { return values_.data(); }
  [[nodiscard]] std::size_t pair_count() const { return pairs_ - 1; }

  /// On planes in the open, of each layer: a level one, and the mean of all upright ones.
  [[nodiscard]] std::span<const float> on_level() const { return on_level_; }
  [[nodiscard]] std::span<const float> on_upright() const { return on_upright_; }
  /// Totals are those of months(), and then illuminance: what a level plane in the open gets of the diffuse light of each.
  [[nodiscard]] std::span<const float> diffuse_of_totals() const { return diffuse_of_totals_; }
  [[nodiscard]] double hours() const { return hours_; }
  [[nodiscard]] double hours_of_illuminance() const { return hours_of_illuminance_; }

 private:
  /// Sums up the parts of a layer, [azimuth][knot], from the zenith down.
  void add_layer(std::size_t layer, std::span<const LightPart> parts, std::size_t azimuths);
  /// Adds a pair between a knot and the next one, which lies `step` behind it.
  static void add(const LightPair* here, std::size_t step, float part, float outward, float upward, LightPair& sum) {
    const LightPair* const above = here + step;
    for (std::size_t k = 0; k < 2; ++k) {
      sum.along[k] += outward * (here->along[k] + part * (above->along[k] - here->along[k]));
      sum.up[k] += upward * (here->up[k] + part * (above->up[k] - here->up[k]));
    }
  }

  std::size_t pairs_ = 0;
  std::vector<unsigned> months_;
  double hours_, hours_of_illuminance_;
  std::vector<LightPair> even_;    ///< even_[knot]: the uniform and the overcast sky, alike at all azimuths
  std::vector<LightPair> values_;  ///< values_[azimuth][knot][pair - 1]
  std::vector<float> on_level_, on_upright_, diffuse_of_totals_;
};

}  // namespace farlod
