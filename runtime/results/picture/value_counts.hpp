// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

}  // namespace farlod
