// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "farlod/surface_kind.hpp"

namespace farlod::ingest {

/// The kind that CityGML's and CityJSON's name of a boundary surface speaks for; unknown for names that do not tell.
/// Outer ceilings look down and outer floors look up: they are the undersides and the terraces of a building.
[[nodiscard]] constexpr SurfaceKind kind_of_surface_name(std::string_view name) {
  if (name == "RoofSurface" || name == "OuterFloorSurface") return SurfaceKind::roof;
  if (name == "WallSurface" || name == "Window" || name == "Door" || name == "WindowSurface" || name == "DoorSurface")
    return SurfaceKind::wall;
  if (name == "GroundSurface" || name == "OuterCeilingSurface") return SurfaceKind::floor;
  return SurfaceKind::unknown;
}

/// Surfaces inside rooms: they hide no sky that the building does not hide.
[[nodiscard]] constexpr bool is_interior_surface_name(std::string_view name) {
  return name == "InteriorWallSurface" || name == "CeilingSurface" || name == "FloorSurface";
}

}  // namespace farlod::ingest
