// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/value_counts.hpp"

#include <algorithm>
#include <cmath>

#include "base/expects.hpp"

namespace farlod {

void ValueCounts::add(double value, double weight) {
  if (std::isnan(value)) return;
  const double inside = std::clamp(value, 0.0, 1.0);
  const auto bin = static_cast<std::size_t>(inside * static_cast<double>(fine_bins));
  weights_[std::min(bin, fine_bins - 1)] += weight;
  weighted_ += weight * inside;
  weight_ += weight;
  ++count_;
}

std::optional<double> ValueCounts::mean() const { return weight_ > 0.0 ? std::optional(weighted_ / weight_) : std::nullopt; }

std::optional<double> ValueCounts::quantile(double share) const {
  if (!(weight_ > 0.0)) return std::nullopt;
  double below = 0.0;
  std::size_t last = 0;
  for (std::size_t bin = 0; bin < fine_bins; ++bin) {
    if (weights_[bin] > 0.0) last = bin;
    below += weights_[bin];
    if (weights_[bin] > 0.0 && below >= share * weight_) break;
  }
  return (static_cast<double>(last) + 0.5) / static_cast<double>(fine_bins);
}

std::vector<double> ValueCounts::shares(std::size_t bins) const {
  FARLOD_EXPECTS(bins > 0 && fine_bins % bins == 0);
  std::vector<double> shares(bins);
  if (!(weight_ > 0.0)) return shares;
  for (std::size_t bin = 0; bin < fine_bins; ++bin) shares[bin / (fine_bins / bins)] += weights_[bin] / weight_;
  return shares;
}

}  // namespace farlod
