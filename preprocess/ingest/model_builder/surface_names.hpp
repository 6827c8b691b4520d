// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "farlod/surface_kind.hpp"

namespace farlod::ingest {

/// The kind of surface that a class name of CityGML or CityJSON stands for; unknown for other names. Outer ceilings face down and
/// outer floors face up: they are the undersides and the terraces of a building.
[[nodiscard]] constexpr SurfaceKind kind_of_surface_name(std::string_view name) {
  if (name == "RoofSurface" || name == "OuterFloorSurface") return SurfaceKind::roof;
  if (name == "WallSurface" || name == "Window" || name == "Door" || name == "WindowSurface" || name == "DoorSurface")
    return SurfaceKind::wall;
  if (name == "GroundSurface" || name == "OuterCeilingSurface") return SurfaceKind::floor;
  return SurfaceKind::unknown;
}

/// Surfaces of rooms. They hide no sky that the building does not hide.
[[nodiscard]] constexpr bool is_interior_surface_name(std::string_view name) {
  return name == "InteriorWallSurface" || name == "CeilingSurface" || name == "FloorSurface";
}

}  // namespace farlod::ingest
