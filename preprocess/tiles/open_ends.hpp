// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "tiles/horizon_edges.hpp"

namespace farlod {

/// Points within this of a line are on it. Files write millimetres, which moves each of the three points that are compared by up
/// to √3/2 mm; a slit as wide as that hides nothing.
inline constexpr double on_line_m = 0.002;

/// Where the border of a surface ends that other edges do not close. Given are the edges of an odd number of triangles; where a
/// long edge meets a chain of shorter ones, file by file an ordinary thing, they close each other although none equals another.
///   (1) without such points, the open edges on each line cover each of its points an even number of times: the surface is closed
///   (2) if the points are all at the ground, so is whatever is open
/// The order is that of the points' coordinates.
[[nodiscard]] std::vector<Point3d> open_ends(std::span<const Segment3d> open_edges);

}  // namespace farlod
