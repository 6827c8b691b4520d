// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "farmap/city_horizon.hpp"
#include "farmap/edge_over_square.hpp"

namespace farlod {

/// What eyes anywhere in a square see of an obstacle: of its one edge, or of the three around it.
class ObstacleOverSquare {
 public:
  /// The borders must outlive it.
  explicit ObstacleOverSquare(const BinBorders& borders)
      : edges_{EdgeOverSquare(borders), EdgeOverSquare(borders), EdgeOverSquare(borders)} {}

  /// `origin` is the square's, in the frame of CityHorizon.
  void look_at(const Obstacle& obstacle, Point2d origin, const Box2d& square);

  /// The obstacle is so close, or hangs over so much of the square, that nothing can be said of it.
  [[nodiscard]] bool surrounds() const { return surrounds_; }
  /// The obstacle lies between them. Not to be asked when it surrounds.
  [[nodiscard]] std::span<EdgeOverSquare> edges() { return std::span(edges_).first(edge_count_); }

 private:
  std::array<EdgeOverSquare, 3> edges_;
  std::size_t edge_count_ = 0;
  bool surrounds_ = false;
};

}  // namespace farlod
