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

/// Which values are counted: shares lie between 0 and 1, and others from 0 to a largest one that nobody knows before.
enum class CountedRange { shares, from_zero };

/// How values are distributed. It holds 10,000 sums, however many values come. Values that come in the same order give the same
/// sums to the bit.
class ValueCounts {
 public:
  explicit ValueCounts(CountedRange range = CountedRange::shares);

  /// NaN is not counted. What lies outside counts as the nearer end.
  void add(double value, double weight = 1.0);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double weight() const { return weight_; }
  /// None before the first value of some weight.
  [[nodiscard]] std::optional<double> mean() const;
  /// The largest value; 0 before the first.
  [[nodiscard]] double largest() const { return largest_; }
  /// The value that `share` of the weight does not exceed, within half a ten thousandth of 1, or of twice the largest value.
  [[nodiscard]] std::optional<double> quantile(double share) const;
  /// The shares of the weight in equal bins from 0 to `end`. The last of them has all from there on, too. `bins` divides 10,000.
  [[nodiscard]] std::vector<double> shares(std::size_t bins, double end = 1.0) const;

 private:
  static constexpr std::size_t fine_bins = 10'000;

  void double_range();

  CountedRange range_;
  double end_;  ///< of the last bin
  std::vector<double> weights_;
  std::size_t count_ = 0;
  double weight_ = 0.0, weighted_ = 0.0, largest_ = 0.0;
};

/// Some values, and what they are called: "pixels", "roofs".
struct HistogramSeries {
  std::string name, size;  ///< `size` is how much there is of it: "1234", "5678 m²"
  ValueCounts counts;
};

/// What a histogram says besides.
struct HistogramCaption {
  std::string quantity;    ///< name of its column, such as "svf"
  std::string shares;      ///< of what: "Share of the pixels"
  std::string unit = "1";  ///< of the quantity, in the words of UDUNITS; "1" of a share
};

inline constexpr std::size_t histogram_bins = 50;

/// Bars of the shares in fifty bins, which are .02 wide where values are shares, of one series or of two side by side, and above
/// them, for each series, a line from its lower to its upper quartile with a stroke at its median and a dot at its mean.
[[nodiscard]] Drawing draw_histogram(std::span<const HistogramSeries> series, const HistogramCaption& caption);

/// The place of a value, as a share of that at the end of the axis, and of a share on the page of draw_histogram; `highest` is
/// the share at the top.
[[nodiscard]] PagePoint histogram_point(double value, double share, double highest);
/// The share at the top of the axis: that of the tallest bar, rounded up to a tick, of which there are five at the most.
[[nodiscard]] double highest_share(std::span<const HistogramSeries> series, double end = 1.0);
[[nodiscard]] Colour colour_of_series(std::size_t n);

}  // namespace farlod
