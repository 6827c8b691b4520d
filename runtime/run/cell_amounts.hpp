// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "farlod/morphology.hpp"
#include "run/cell_faces.hpp"
#include "run/zone_plan.hpp"

namespace farlod {

/// Where the wind comes from, as vectors of length 1 in the plan of the grid frame.
using WindDirections = std::array<Point2d, wind_directions>;

/// What a building has in a cell.
struct BuildingPart {
  double plan_area_m2 = 0.0, volume_m3 = 0.0;
};

/// All of CellAmounts but `plan_area_m2`, and but what `buildings` decides.
struct CellForm {
  CellAmounts amounts;
  std::map<std::uint32_t, BuildingPart> buildings;  ///< by their numbers

  void add(const CellForm& other);
  /// With the number of buildings, and their heights.
  [[nodiscard]] CellAmounts all() const;
};

/// What the whole cell has, or what lies in the trapezoids (cell frame), if there is a list.
[[nodiscard]] CellForm form_of(const CellFaces& faces, const WindDirections& winds,
                               const std::vector<ZoneTrapezoid>* within = nullptr);

}  // namespace farlod
