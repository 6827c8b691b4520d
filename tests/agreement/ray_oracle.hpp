// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// An independent ray caster: CGAL's AABB tree with exact predicates, on a city's facets as they were before anything was turned,
/// cut or rounded.
class RayOracle {
 public:
  using Corners = std::array<Point3d, 3>;

  /// `ground` are triangles beside the city's facets. City frame.
  explicit RayOracle(const CityModel& city, std::span<const Corners> ground = {});
  ~RayOracle();

  /// Whether the ray from `origin` meets a facet. City frame.
  [[nodiscard]] bool blocks(const Point3d& origin, const Point3d& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
