// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// The known height of the ground that is nearest to a place, and how far away it is.
struct NearestHeight {
  double height_m = 0.0;
  double distance_m = 0.0;
};

/// Empty for a place between known heights.
using NearestHeightBeyond = std::function<std::optional<NearestHeight>(Point2d p_grid)>;

/// Nodes of the ground along the border of a rectangle, where it lies beyond all known heights. With corners alone, the ground
/// between two of them would be a ramp from one to the other, whatever stands beside it.
///   (1) Corners are among them. Others are half as far from the next as known heights are from the middle between the two, or
///       nearer, but not below 5 m.
///   (2) The height is the mean of the nearest heights along the border, as far to both sides as the nearest is away, those
///       beside it counting most: from one known height to the next it changes over a way as long as they are far.
///   (3) Nodes between two of the same height are left out: a level border has its corners.
[[nodiscard]] std::vector<Point3d> border_nodes(const Box2d& rectangle, const NearestHeightBeyond& nearest_beyond);

}  // namespace farlod::tiles
