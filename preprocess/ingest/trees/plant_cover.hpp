// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/trees/tree_collector.hpp"

namespace farlod::ingest {

/// A lower one is ground cover: it is not above the eyes of a pedestrian, and rasters of canopies are usually cut there, too.
inline constexpr double lowest_plant_cover_m = 2.0;

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
