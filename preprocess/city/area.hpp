// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A part of the plane: all of its shapes together, in the frame that the function says which hands it out.
struct Area {
  using Line = std::vector<Point2d>;
  using Polygon = std::vector<Line>;  ///< rings, which may repeat their first point; between them by the even-odd rule

  std::vector<Point2d> points;
  std::vector<Line> lines;
  std::vector<Polygon> polygons;

  [[nodiscard]] std::size_t shape_count() const { return points.size() + lines.size() + polygons.size(); }

  template <class Visit>
  void for_each_point(const Visit& visit) {
    for (Point2d& p : points) visit(p);
    for (Line& line : lines)
      for (Point2d& p : line) visit(p);
    for (Polygon& polygon : polygons)
      for (Line& ring : polygon)
        for (Point2d& p : ring) visit(p);
  }
};

[[nodiscard]] inline Area area_of(const Box2d& box) {
  return {{}, {}, {{{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}}}};
}

[[nodiscard]] inline Box2d outline_of(Area area) {
  Box2d outline;
  area.for_each_point([&](const Point2d& p) { outline.add(p); });
  return outline;
}

}  // namespace farlod
