// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/picture/drawing.hpp"

namespace farlod {

/// How values between 0 and 1 are distributed. It holds 10,000 sums, however many values come. Values that come in the same order
/// give the same sums to the bit.
class ValueCounts {
 public:
  ValueCounts() : weights_(fine_bins) {}

  /// NaN is not counted. What lies outside counts as the nearer end.
  void add(double value, double weight = 1.0);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double weight() const { return weight_; }
  /// None before the first value of some weight.
  [[nodiscard]] std::optional<double> mean() const;
  /// The value that `share` of the weight does not exceed, within half a ten thousandth.
  [[nodiscard]] std::optional<double> quantile(double share) const;
  /// The shares of the weight in equal bins. The last of them has its upper end, too. `bins` divides 10,000.
  [[nodiscard]] std::vector<double> shares(std::size_t bins) const;

 private:
  static constexpr std::size_t fine_bins = 10'000;

  std::vector<double> weights_;
  std::size_t count_ = 0;
  double weight_ = 0.0, weighted_ = 0.0;
};

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
/// The share at the top of the axis: that of the tallest bar, rounded up to a tick, of which there are five at the most.
[[nodiscard]] double highest_share(std::span<const HistogramSeries> series);
[[nodiscard]] Colour colour_of_series(std::size_t n);

}  // namespace farlod
