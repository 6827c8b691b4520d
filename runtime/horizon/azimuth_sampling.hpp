// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The azimuths of a sampling as the kernels read them; what the arrays hold is said at AzimuthSampling.
struct AzimuthView {
  const float *cosine, *sine;
  const std::uint32_t *first_of_slot, *first_of_sector;
  std::uint32_t size;
  float slots;
};

/// Azimuths around the turn, ascending, at which horizons are sampled. Counter-clockwise from the grid's x axis.
class AzimuthSampling {
 public:
  /// The middles of equal parts of the turn, fixed in the city frame: turning the grid changes no receiver's azimuths.
  [[nodiscard]] static AzimuthSampling even(std::size_t count, const GridRotation& rotation);
  /// The azimuths of some directions (grid frame). A direction straight up has no azimuth: it gets that of the x axis.
  explicit AzimuthSampling(std::span<const Point3d> directions);

  [[nodiscard]] std::size_t size() const { return turns_.size(); }
  [[nodiscard]] const float* cosine() const { return cosine_.data(); }
  [[nodiscard]] const float* sine() const { return sine_.data(); }
  /// The last azimuth that is no farther around the turn than a direction, and the next one; the first one comes after the last.
  struct Pair {
    std::uint32_t before, after;
  };
  [[nodiscard]] Pair around(Point2d direction) const;
  /// For each azimuth, the number of the direction that it belongs to.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

  /// Sectors are 64 equal parts of the turn, in pseudo_angle (lanes.hpp). For each the first azimuth at or after its beginning,
  /// and one entry more for the end: 65.
  static constexpr std::size_t sectors = 64;
  [[nodiscard]] const std::uint32_t* first_of_sector() const { return first_of_sector_.data(); }

  /// Slots are `slots()` equal parts of the turn, at least four times as many as there are azimuths. The array covers three turns
  /// in a row: for each slot the first azimuth at or after its beginning, counted on from turn to turn, and one entry more for
  /// the end.
  [[nodiscard]] const std::uint32_t* first_of_slot() const { return first_of_slot_.data(); }
  [[nodiscard]] std::size_t slots() const { return first_of_slot_.size() / 3; }

  [[nodiscard]] AzimuthView view() const {
    return {
        cosine(), sine(), first_of_slot(), first_of_sector(), static_cast<std::uint32_t>(size()), static_cast<float>(slots())};
  }

 private:
  /// The azimuths of unit vectors in any order.
  explicit AzimuthSampling(std::span<const Point2d> unit_vectors);
  /// For each of `count` equal parts of the turn (a power of two) the first azimuth at or after its beginning, and the end.
  [[nodiscard]] std::vector<std::uint32_t> first_of_parts(std::size_t count) const;

  std::vector<float> turns_;  ///< pseudo_angle, less than 1
  std::vector<float> cosine_, sine_;
  std::vector<std::uint32_t> order_, first_of_slot_, first_of_sector_;
};

/// Directions above the horizontal, in the order of their azimuths: one direction at each azimuth of a sampling.
class DirectionSampling {
 public:
  explicit DirectionSampling(std::span<const Point3d> directions);

  [[nodiscard]] std::size_t size() const { return directions_.size(); }
  [[nodiscard]] const AzimuthSampling& azimuths() const { return azimuths_; }
  [[nodiscard]] const Point3f& direction(std::size_t k) const { return directions_[k]; }
  /// The tangents of the directions' elevations; infinite straight up.
  [[nodiscard]] std::span<const float> slopes() const { return slopes_; }

 private:
  AzimuthSampling azimuths_;
  std::vector<Point3f> directions_;
  std::vector<float> slopes_;
};

}  // namespace farlod
