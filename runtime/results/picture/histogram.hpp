// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "results/picture/drawing.hpp"
#include "results/picture/value_counts.hpp"

namespace farlod {

/// Some values, and what they are called: "pixels", "roofs".
struct HistogramSeries {
  std::string name, size;  ///< `size` is how much there is of it: "1234", "5678 m²"
  ValueCounts counts;
};

/// What a histogram says besides.
struct HistogramCaption {
  std::string quantity;  ///< "svf" or "svf_solid"
  std::string shares;    ///< of what: "Share of the pixels"
};

inline constexpr std::size_t histogram_bins = 50;

/// Bars of the shares in bins of .02, of one series or of two side by side, and above them, for each series, a line from its
/// lower to its upper quartile with a stroke at its median and a dot at its mean.
[[nodiscard]] Drawing draw_histogram(std::span<const HistogramSeries> series, const HistogramCaption& caption);

/// The place of a value and of a share on the page of draw_histogram; `highest` is the share at the top.
[[nodiscard]] PagePoint histogram_point(double value, double share, double highest);
/// The share at the top of the axis: the least of 1, 2 or 5 times a power of ten that no bar exceeds.
[[nodiscard]] double highest_share(std::span<const HistogramSeries> series);
[[nodiscard]] Colour colour_of_series(std::size_t n);

}  // namespace farlod
