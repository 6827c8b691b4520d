// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "farlod/point.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// What a surface of the city is. The numbers are part of the package format.
enum class SurfaceKind : std::uint8_t {
  unknown = 0,  ///< only before the tiles stage, which decides by the normal
  ground = 1,   ///< the terrain, of no building
  roof = 2,
  wall = 3,
  floor = 4,       ///< looks down: the ground slab of a building, the underside of a bridge
  foundation = 5,  ///< of no file: what closes the gap below a building's lowest floor, or a crack
};
inline constexpr std::array<Word<SurfaceKind>, 6> surface_kind_words{{{"unknown", SurfaceKind::unknown},
                                                                      {"ground", SurfaceKind::ground},
                                                                      {"roof", SurfaceKind::roof},
                                                                      {"wall", SurfaceKind::wall},
                                                                      {"floor", SurfaceKind::floor},
                                                                      {"foundation", SurfaceKind::foundation}}};

/// A surface whose outward normal is at least this steep counts as a wall (cosine of 75° to the vertical).
inline constexpr double wall_normal_z = 0.2588190451025207;

/// The kind that an outward normal of length 1 speaks for.
[[nodiscard]] inline SurfaceKind kind_of_normal(const Point3d& normal) {
  if (std::abs(normal.z) < wall_normal_z) return SurfaceKind::wall;
  return normal.z > 0.0 ? SurfaceKind::roof : SurfaceKind::floor;
}

}  // namespace farlod
