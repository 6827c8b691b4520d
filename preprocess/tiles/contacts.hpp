// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "farlod/point.hpp"
#include "package/horizon_edge.hpp"
#include "package/tile_set.hpp"

namespace farlod::tiles {

/// A triangle touches an edge when it is nearer than this: walls end on roofs, and balconies at walls, with gaps of about a
/// centimetre.
inline constexpr double contact_m = 0.02;
/// A crack is wider than this. What is narrower comes from the rounding of coordinates.
inline constexpr double least_crack_m = 5e-5;

using ClosingTriangle = std::array<Point3d, 3>;

/// The parts of a lower border that stay open: no triangle of the tile, of any building, touches the border there and continues
/// below it. The border and the tile are in the frame of the same cell. Where what touches it leaves a crack, adds the triangles
/// that close it: from each place of the border to the nearest one of a triangle that continues below.
[[nodiscard]] std::vector<HorizonEdge> without_contacts(const HorizonEdge& edge, const Tile& tile,
                                                        std::vector<ClosingTriangle>& closing);

/// Adds what closes the crack between two segments that run side by side the same way; nothing where they meet.
void close_crack(const std::array<Point3d, 2>& border, const std::array<Point3d, 2>& other,
                 std::vector<ClosingTriangle>& closing);

}  // namespace farlod::tiles
