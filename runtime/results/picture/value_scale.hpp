// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "results/picture/picture.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {

/// The least of 1, 2 and 5 times a power of ten that divides a length (positive) into so many steps at the most.
[[nodiscard]] double tick_step(double length, int most_steps);
/// A multiple of a step, with as many digits behind the point as the step has: "0.2", "1000".
[[nodiscard]] std::string tick_text(double value, double step);

/// A unit in the words of UDUNITS as people write it: "kWh/m²" of "kW h m-2"; empty of a share, and of what is not known.
[[nodiscard]] std::string sign_of_unit(const std::string& unit);

/// What the colours of a map stand for.
struct ValueScale {
  std::string title;     ///< what the band is, and its name: "Sky view factor (svf)"
  std::string subtitle;  ///< the unit in words
  std::string unit;      ///< the same as a sign, "kWh/m²"; empty of a share
  double end = 1.0;      ///< the largest value that has a colour; the least is 0
  bool falls = false;    ///< the larger the darker: of shade, the sun is bright

  [[nodiscard]] Colour colour_of(double value) const { return colour_of_svf(falls ? 1.0 - value / end : value / end); }
  [[nodiscard]] double step() const { return tick_step(end, 6); }
  /// The multiples of step() from 0 on.
  [[nodiscard]] std::vector<double> ticks() const;
};

/// The scale of a band whose values are `max_value` at the most. Shares end at 1, other values at `max_value`, rounded up to two
/// digits.
[[nodiscard]] ValueScale scale_of(const Band& band, double max_value);

}  // namespace farlod
