// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "farlod/quantities.hpp"
#include "scene/seen_surfaces.hpp"

namespace farlod {

/// The columns of a view: sky, ground, roofs, walls by the parts of the turn that are asked for, crowns, other.
class ViewLayout {
 public:
  /// 4 or 8 parts, each centred at its azimuth.
  explicit ViewLayout(std::size_t wall_sectors);
  [[nodiscard]] std::size_t count() const { return view_class_count - wall_slices + wall_sectors_; }
  [[nodiscard]] std::size_t column_of(ViewClass what) const { return columns_[static_cast<std::size_t>(what)]; }

 private:
  std::size_t wall_sectors_;
  std::array<std::size_t, view_class_count> columns_{};
};

/// The faces of Quantities::view_cube in the order of their columns: straight up and down, and at true azimuths.
struct FaceOfCube {
  const char* word;
  const char* meaning;
  double azimuth_deg = 0.0, normal_z = 0.0;
};
inline constexpr std::array<FaceOfCube, 6> faces_of_cube{{{"up", "upper", 0.0, 1.0},
                                                          {"down", "lower", 0.0, -1.0},
                                                          {"north", "northern", 0.0},
                                                          {"east", "eastern", 90.0},
                                                          {"south", "southern", 180.0},
                                                          {"west", "western", 270.0}}};

/// What the columns of Quantities::view_factors are, in the order of ViewLayout.
void describe_views(const Quantities& quantities, std::vector<ColumnDescription>& columns);
/// The same below the horizontal, where no sky is.
void describe_views_below(const Quantities& quantities, std::vector<ColumnDescription>& columns);
/// The same of each of the faces_of_cube, face by face.
void describe_views_of_cube(const Quantities& quantities, std::vector<ColumnDescription>& columns);
void describe_views_of_sphere(const Quantities& quantities, std::vector<ColumnDescription>& columns);
void describe_views_of_eye(const Quantities& quantities, std::vector<ColumnDescription>& columns);
void describe_view_of_building(const Quantities& quantities, std::vector<ColumnDescription>& columns);

}  // namespace farlod
