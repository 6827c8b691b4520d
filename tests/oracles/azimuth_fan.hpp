// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/azimuth.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Directions in the order of their azimuths, so that those between two azimuths are a row. All point above the horizontal.
class AzimuthFan {
 public:
  explicit AzimuthFan(std::span<const Point3d> directions);

  [[nodiscard]] std::size_t size() const { return slope_.size(); }
  /// Of the n-th direction: its place among those given, cosine and sine of its azimuth, the tangent of its elevation, and its
  /// pseudo-angle.
  [[nodiscard]] std::span<const std::uint32_t> place() const { return place_; }
  [[nodiscard]] std::span<const float> cosine() const { return cosine_; }
  [[nodiscard]] std::span<const float> sine() const { return sine_; }
  [[nodiscard]] std::span<const float> slope() const { return slope_; }
  [[nodiscard]] std::span<const double> pseudo_angles() const { return pseudo_angles_; }
  /// For each direction the bin of its azimuth.
  [[nodiscard]] std::vector<std::uint32_t> bins(const AzimuthBins& bins) const;
  /// The first direction whose pseudo-angle is at least this; size() when there is none. Any pseudo-angle from 0 to 1.
  [[nodiscard]] std::size_t first_from(double angle) const;

 private:
  /// A direction straight up has no azimuth; any will do, since no horizon is as steep.
  [[nodiscard]] static double pseudo_angle_of(const Point3d& d) {
    return d.x == 0.0 && d.y == 0.0 ? 0.0 : pseudo_angle({d.x, d.y});
  }

  std::vector<std::uint32_t> place_, first_of_slot_;
  std::vector<double> pseudo_angles_;
  std::vector<float> cosine_, sine_, slope_;
};

inline AzimuthFan::AzimuthFan(std::span<const Point3d> directions) : place_(directions.size()) {
  std::iota(place_.begin(), place_.end(), 0U);
  std::stable_sort(place_.begin(), place_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return pseudo_angle_of(directions[a]) < pseudo_angle_of(directions[b]);
  });
  for (const std::uint32_t n : place_) {
    const Point3d& d = directions[n];
    const double across = std::hypot(d.x, d.y);
    pseudo_angles_.push_back(pseudo_angle_of(d));
    cosine_.push_back(static_cast<float>(across > 0.0 ? d.x / across : 1.0));
    sine_.push_back(static_cast<float>(across > 0.0 ? d.y / across : 0.0));
    slope_.push_back(static_cast<float>(d.z / across));
  }
  // A slot for each direction on average: a look-up finds its place within a step or two
  first_of_slot_.resize(directions.size() + 2);
  for (std::size_t slot = 0; slot < first_of_slot_.size(); ++slot) {
    const double from = static_cast<double>(slot) / static_cast<double>(directions.size() + 1);
    first_of_slot_[slot] =
        static_cast<std::uint32_t>(std::lower_bound(pseudo_angles_.begin(), pseudo_angles_.end(), from) - pseudo_angles_.begin());
  }
}

inline std::vector<std::uint32_t> AzimuthFan::bins(const AzimuthBins& bins) const {
  std::vector<std::uint32_t> result;
  for (std::size_t n = 0; n < size(); ++n) result.push_back(bins.bin_of({cosine_[n], sine_[n]}));
  return result;
}

inline std::size_t AzimuthFan::first_from(double angle) const {
  const auto slot = static_cast<std::size_t>(angle * static_cast<double>(size() + 1));
  std::size_t n = first_of_slot_[std::min(slot, first_of_slot_.size() - 1)];
  while (n > 0 && pseudo_angles_[n - 1] >= angle) --n;
  while (n < pseudo_angles_.size() && pseudo_angles_[n] < angle) ++n;
  return n;
}

}  // namespace farlod
