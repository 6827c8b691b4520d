// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "farlod/expects.hpp"
#include "farlod/horizon/azimuth.hpp"

namespace farlod {

/// The directions of the borders between azimuth bins, ready for use: there are few of them, and a city asks for them often.
class BinBorders {
 public:
  explicit BinBorders(AzimuthBins bins) : bins_(bins), cos_half_bin_(std::cos(0.5 * bins.width_rad())) {
    for (std::int64_t n = -std::int64_t{bins_.count}; n <= bins_.count; ++n) {
      const double azimuth = static_cast<double>(n) * bins_.width_rad();
      cosine_.push_back(std::cos(azimuth));
      sine_.push_back(std::sin(azimuth));
    }
  }

  [[nodiscard]] const AzimuthBins& bins() const { return bins_; }
  [[nodiscard]] double cos_half_bin() const { return cos_half_bin_; }
  /// Cosines and sines of a bin's lower border and of those that follow, at most a turn from the x axis to either side.
  [[nodiscard]] const double* cosines_from(std::int64_t bin) const { return &cosine_[place(bin)]; }
  [[nodiscard]] const double* sines_from(std::int64_t bin) const { return &sine_[place(bin)]; }

 private:
  [[nodiscard]] std::size_t place(std::int64_t bin) const {
    FARLOD_EXPECTS(bin >= -std::int64_t{bins_.count} && bin <= bins_.count);
    return static_cast<std::size_t>(bin + bins_.count);
  }

  AzimuthBins bins_;
  double cos_half_bin_;
  std::vector<double> cosine_, sine_;
};

/// Calls visit(n, bin) for `count` bins from an unwrapped one on: n from 0, and the bin within the turn.
template <class Visit>
void for_each_bin(const AzimuthBins& bins, std::int64_t first, std::size_t count, const Visit& visit) {
  std::uint32_t bin = bins.wrapped(first);
  for (std::size_t n = 0; n < count; ++n) {
    visit(n, bin);
    if (++bin == bins.count) bin = 0;
  }
}

}  // namespace farlod
