// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/azimuth.hpp"
#include "base/expects.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// As AzimuthBins::wrapped, for bins less than a turn off: divisions would take longer than what is done with most bins.
[[nodiscard]] inline std::uint32_t wrapped_once(const AzimuthBins& bins, std::int64_t bin) {
  const std::int64_t turn = bins.count;
  return static_cast<std::uint32_t>(bin < 0 ? bin + turn : bin < turn ? bin : bin - turn);
}

/// Consecutive bins, which may pass the end of the turn: the first is unwrapped, and lies less than a turn off.
struct BinRange {
  std::int64_t first = 0;
  std::size_t count = 0;
};

/// The directions of the borders between azimuth bins, tabulated: there are few of them, and each edge of a city needs some.
class BinBorders {
 public:
  /// A bin must be narrower than half a turn.
  explicit BinBorders(AzimuthBins bins) : bins_(bins), cos_half_bin_(std::cos(0.5 * bins.width_rad())) {
    FARLOD_EXPECTS(bins.count >= 3);
    for (std::int64_t n = -std::int64_t{bins_.count}; n <= 2 * std::int64_t{bins_.count}; ++n) {
      const double azimuth = static_cast<double>(n) * bins_.width_rad();
      cosine_.push_back(std::cos(azimuth));
      sine_.push_back(std::sin(azimuth));
    }
    fill_guesses();
  }

  [[nodiscard]] const AzimuthBins& bins() const { return bins_; }
  [[nodiscard]] double cos_half_bin() const { return cos_half_bin_; }
  /// The bin of a direction other than zero, from half a turn before the x axis to half a turn after it. As AzimuthBins::bin_of,
  /// but without an arc tangent: the pseudo-angle gives a guess, and the border above it decides between that bin and the next.
  [[nodiscard]] std::int64_t bin_of(Point2d direction) const {
    std::int64_t bin = guesses_[static_cast<std::size_t>(pseudo_angle(direction) * guesses_per_turn())];
    bin += cosines_from(bin + 1)[0] * direction.y - sines_from(bin + 1)[0] * direction.x >= 0.0 ? 1 : 0;
    return 2 * bin < bins_.count ? bin : bin - bins_.count;
  }
  /// The bins from one direction counter-clockwise to another.
  [[nodiscard]] BinRange between(Point2d from, Point2d to) const {
    const std::int64_t first = bin_of(from);
    return {first, std::size_t{wrapped_once(bins_, bin_of(to) - first)} + 1};
  }
  /// Cosines and sines of a bin's lower border and of those that follow, up to two turns from the x axis.
  [[nodiscard]] const double* cosines_from(std::int64_t bin) const { return &cosine_[index_of(bin)]; }
  [[nodiscard]] const double* sines_from(std::int64_t bin) const { return &sine_[index_of(bin)]; }

 private:
  [[nodiscard]] std::size_t index_of(std::int64_t bin) const {
    FARLOD_EXPECTS(bin >= -std::int64_t{bins_.count} && bin <= 2 * std::int64_t{bins_.count});
    return static_cast<std::size_t>(bin + bins_.count);
  }

  /// Guesses are so dense that at most one border lies between two: what spans δ of pseudo-angle spans at most 8δ of
  /// azimuth, and 8/16 is less than the 2π of a bin (both over the number of bins).
  static constexpr std::uint32_t guesses_per_bin = 16;
  [[nodiscard]] double guesses_per_turn() const { return double{guesses_per_bin} * bins_.count; }
  void fill_guesses() {
    const std::size_t count = std::size_t{guesses_per_bin} * bins_.count;
    std::int64_t bin = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const double begin = static_cast<double>(n) / guesses_per_turn();
      while (bin + 1 < bins_.count && pseudo_angle_of_border(bin + 1) <= begin) ++bin;
      guesses_.push_back(bin);
    }
    guesses_.push_back(bins_.count - 1);  // a direction just below the x axis may be rounded to the whole turn
  }
  [[nodiscard]] double pseudo_angle_of_border(std::int64_t bin) const {
    return pseudo_angle({cosine_[index_of(bin)], sine_[index_of(bin)]});
  }

  AzimuthBins bins_;
  double cos_half_bin_;
  std::vector<double> cosine_, sine_;
  std::vector<std::int64_t> guesses_;  ///< for equal parts of the pseudo-angle, the bin in which each begins
};

/// A direction, turned counter-clockwise by an angle so small that it equals its tangent.
[[nodiscard]] inline Point2d turned(Point2d d, double by_rad) { return {d.x - by_rad * d.y, d.y + by_rad * d.x}; }

/// Calls visit(n, bin) for `count` bins from an unwrapped one on: n from 0, and the bin within the turn.
template <class Visit>
void for_each_bin(const AzimuthBins& bins, std::int64_t first, std::size_t count, const Visit& visit) {
  std::uint32_t bin = wrapped_once(bins, first);
  for (std::size_t n = 0; n < count; ++n) {
    visit(n, bin);
    if (++bin == bins.count) bin = 0;
  }
}

}  // namespace farlod
