// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/frame.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Azimuths around the turn, ascending, in which horizons are known. Counter-clockwise from the grid's x axis.
class AzimuthRing {
 public:
  /// The middles of equal parts of the turn, fixed in the city frame: turning the grid changes no receiver's azimuths.
  [[nodiscard]] static AzimuthRing even(std::size_t count, const GridRotation& rotation);
  /// The azimuths of some directions (grid frame), in the order that is to be found in place(). A direction straight up has none:
  /// it gets any.
  [[nodiscard]] static AzimuthRing of(std::span<const Point3d> directions);

  [[nodiscard]] std::size_t size() const { return turns_.size(); }
  [[nodiscard]] const float* cosine() const { return cosine_.data(); }
  [[nodiscard]] const float* sine() const { return sine_.data(); }
  /// For each azimuth, which of those that were given it is.
  [[nodiscard]] std::span<const std::uint32_t> place() const { return place_; }

  /// Sixty-four equal parts of the turn, as `pseudo_angle` (lanes.hpp) count, and for each the first azimuth at or beyond its
  /// beginning; one more for the end.
  static constexpr std::size_t sectors = 64;
  [[nodiscard]] const std::uint32_t* first_of_sector() const { return first_of_sector_.data(); }

  /// Three turns in a row, each in `slots()` equal parts, finer than the azimuths lie. For each part the first azimuth at or
  /// beyond its beginning, counted on from turn to turn; one more for the end.
  [[nodiscard]] const std::uint32_t* first_of_slot() const { return first_of_slot_.data(); }
  [[nodiscard]] std::size_t slots() const { return first_of_slot_.size() / 3; }

 private:
  /// Of unit vectors; order does not matter.
  explicit AzimuthRing(std::span<const Point2d> directions);

  std::vector<float> turns_;  ///< pseudo_angle, less than 1
  std::vector<float> cosine_, sine_;
  std::vector<std::uint32_t> place_, first_of_slot_, first_of_sector_;

  /// Of so many parts, a power of two.
  [[nodiscard]] std::vector<std::uint32_t> first_of_parts(std::size_t count) const;
};

}  // namespace farlod
