// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "farlod/point.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// The placement of a prototype (implicit geometry of CityGML): a matrix in metres, then a translation to the reference point.
class Placement {
 public:
  /// From the 16 numbers of a matrix, row by row; the last row is not used. Without numbers, the matrix is the identity. Empty
  /// when there are not 16 numbers, or when one is NaN.
  [[nodiscard]] static std::optional<Placement> from(std::span<const double> matrix, const Point3d& reference_point);

  [[nodiscard]] Point3d place(const Point3d& p_prototype) const;
  /// The placed rings. A matrix that mirrors also reverses them, so that they keep their outer side.
  [[nodiscard]] Rings place(const Rings& rings_prototype) const;

 private:
  Placement(const Point3d& x, const Point3d& y, const Point3d& z, const Point3d& origin)
      : x_axis_(x), y_axis_(y), z_axis_(z), origin_(origin) {}

  Point3d x_axis_, y_axis_, z_axis_, origin_;
};

}  // namespace farlod::ingest
