// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::ingest {

/// What a city model says of a tree.
struct TreeShape {
  std::string name;
  StatedSizes sizes;
  std::optional<Point3d> reference_point;  ///< of an implicit geometry
  Box2d box;                               ///< around its explicit geometry
  double lowest = 0.0, highest = 0.0;      ///< of that, where it is not empty

  /// One that is not finite is left out.
  void add_corner(const Point3d& p) {
    if (!std::isfinite(p.x + p.y + p.z)) return;
    lowest = box.empty() ? p.z : std::min(lowest, p.z);
    highest = box.empty() ? p.z : std::max(highest, p.z);
    box.add(horizontal(p));
  }
  /// Gives the tree to the collector. Boxes in degrees have no width in metres.
  void hand_over(TreeCollector& trees) {
    // Most write metres, as CityGML asks for; no trunk is thicker than 3 m, but many have so many centimetres
    constexpr double thickest_m = 3.0, metres_in_a_centimetre = 0.01;
    if (sizes.trunk_diameter_m && *sizes.trunk_diameter_m > thickest_m) *sizes.trunk_diameter_m *= metres_in_a_centimetre;
    if (reference_point) return trees.add(name, horizontal(*reference_point), sizes);
    if (box.empty()) return trees.note(ProblemCode::no_geometry, name, "it has neither a reference point nor a geometry");
    const Point2d size = box.high - box.low;
    const bool is_in_metres = std::max(size.x, size.y) > 0.05;
    if (!sizes.crown_diameter_m && is_in_metres) sizes.crown_diameter_m = 0.5 * (size.x + size.y);
    if (!sizes.height_m && highest > lowest) sizes.height_m = highest - lowest;
    trees.add(name, 0.5 * (box.low + box.high), sizes);
  }
};

/// What a city model says of a plant cover: an area that is full of plants, such as a wood or a hedge.
///   (1) its height is `averageHeight`; without one, that of its solid on average: the volume over the area in the plan
///   (2) it becomes crowns on a lattice, squares along the axes of the file, whose centres are in the plan of its surfaces: from
///       the ground to that height
///   (3) the squares are a quarter of the cover's width: at least 0.25 m and at most 2 m, and larger where there would be too
///   many (4) one without a height, one lower than lowest_plant_cover_m and one in degrees become none, and are counted
class PlantCover {
 public:
  using Ring = std::vector<Point3d>;
  /// The outer ring, and those of holes.
  using Face = std::vector<Ring>;

  std::string name;
  std::optional<double> average_height_m;

  /// Surfaces of several levels of detail may come in any order: those of the highest count.
  void begin_geometry(int level_of_detail, bool is_solid);
  /// Adds a face to the geometry that was begun last. A face that is not finite is left out.
  void add_face(Face face);

  /// Gives the crowns to the collector.
  void hand_over(TreeCollector& trees) const;

 private:
  [[nodiscard]] std::optional<double> height_m() const;

  int level_of_detail_ = -1;
  bool is_solid_ = false, is_wanted_ = false;
  std::vector<Face> faces_;
};

}  // namespace farlod::ingest
