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

namespace farlod {

/// What a table has of each direction. Totals follow, direct and diffuse together: the energy of each month in kWh/m², and the
/// illuminance in lx h.
enum class LightLayer : std::size_t {
  direct,    ///< kWh/m²
  diffuse,   ///< kWh/m²
  overcast,  ///< the CIE's overcast sky: 1 on a level plane
  uniform,   ///< a sky of the same radiance everywhere: 1 on a level plane
  first_total
};

/// When an interval begins, as ISO 8601 has it without marks that names of columns may not have: `20260621T1000`.
[[nodiscard]] std::string begin_text_of(const LightInterval& interval);

/// The months of a period that irradiation has columns for, ascending: none unless they are asked for.
[[nodiscard]] std::vector<unsigned> months_by_name(const Light& light);

/// The light of a period as one distribution over the sky (D. Robinson and A. Stone, PLEA 2004), integrated for the directions
/// above a slope of each azimuth: then the energy that falls on a receiver is a sum over its horizon, however many hours the
/// period has. Receivers with a normal n get n · ∫ ω L(ω) dω; of ω the parts along the azimuth and up are integrated.
///   (1) level, the sums of all azimuths are the irradiations of the intervals, but for rounding
///   (2) between the knots of the table integrals are interpolated
class LightTable {
 public:
  /// Azimuths are shares of the turn, clockwise from true north; each stands for the same part of it.
  LightTable(const Light& light, std::span<const double> turns, bool with_illuminance = false);

  /// With those of twelve months, and illuminance.
  static constexpr std::size_t most_layers = 20;
  /// Layers of a knot, padded to whole groups of four.
  [[nodiscard]] std::size_t layers() const { return layers_; }
  /// Months that have layers: months_by_name.
  [[nodiscard]] std::span<const unsigned> months() const { return months_; }

  /// Where a slope t, 0 or more, lies among the knots, from 0 to `last_knot`: they are even in t / (1 + t), and .22° apart at the
  /// horizon and at the zenith, .45° at 45°.
  static constexpr std::size_t last_knot = 256;
  [[nodiscard]] static float place_of(float slope) {
    const float finite = std::min(slope, 1e6F);
    return static_cast<float>(last_knot) * (finite / (1.0F + finite));
  }
  /// What comes from above a place of an azimuth, for a normal's parts along the azimuth and up, of each layer.
  void read_above(std::size_t azimuth, float place, float outward, float upward, float* layers) const {
    const std::size_t knot = std::min(static_cast<std::size_t>(place), last_knot - 1);
    const float part = place - static_cast<float>(knot);
    const float* here = &values_[(azimuth * (last_knot + 1) + knot) * 2 * layers_];
    const float* above = here + 2 * layers_;
    for (std::size_t n = 0; n < layers_; n += group, here += 2 * group, above += 2 * group, layers += group) {
      for (std::size_t k = 0; k < group; ++k)
        layers[k] = upward * (here[group + k] + part * (above[group + k] - here[group + k]));
      if (outward == 0.0F) continue;
      for (std::size_t k = 0; k < group; ++k) layers[k] += outward * (here[k] + part * (above[k] - here[k]));
    }
  }

  /// On planes in the open, of each layer: a level one, and the mean of all upright ones.
  [[nodiscard]] std::span<const float> on_level() const { return on_level_; }
  [[nodiscard]] std::span<const float> on_upright() const { return on_upright_; }
  /// Totals are those of months(), and then illuminance: what a level plane in the open gets of the diffuse light of each.
  [[nodiscard]] std::span<const float> diffuse_of_totals() const { return diffuse_of_totals_; }
  [[nodiscard]] double hours() const { return hours_; }
  [[nodiscard]] double hours_of_illuminance() const { return hours_of_illuminance_; }

 private:
  std::size_t layers_;
  std::vector<unsigned> months_;
  double hours_ = 0.0, hours_of_illuminance_ = 0.0;
  /// Layers that lie side by side, for vectors of the processor.
  static constexpr std::size_t group = 4;
  /// values_[azimuth][knot][group of layers]: the integrals along the azimuth of four layers, then those upwards.
  std::vector<float> values_;
  std::vector<float> on_level_, on_upright_, diffuse_of_totals_;
};

}  // namespace farlod
