// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "farlod/point.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// Where a prototype (CityGML's implicit geometry) stands: turned and scaled in metres, then moved to its reference point.
class Placement {
 public:
  /// Of 16 numbers, row by row, of which the last row is not used; no matrix at all leaves the prototype as it is.
  /// Empty when there are other than 16 numbers, or a number that is none.
  [[nodiscard]] static std::optional<Placement> from(std::span<const double> matrix, const Point3d& reference_point);

  [[nodiscard]] Point3d place(const Point3d& p_prototype) const;
  /// Placed, and still facing the same way: a matrix that mirrors turns them round.
  [[nodiscard]] Rings place(const Rings& rings_prototype) const;

 private:
  Placement(const Point3d& x, const Point3d& y, const Point3d& z, const Point3d& origin)
      : x_axis_(x), y_axis_(y), z_axis_(z), origin_(origin) {}

  Point3d x_axis_, y_axis_, z_axis_, origin_;
};

}  // namespace farlod::ingest
