// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "tiles/horizon_edges.hpp"

namespace farlod {

/// Edges that meet a longer one lie on its line to this: rounding coordinates to millimetres moves each of the three points by up
/// to √3/2 mm.
inline constexpr double on_line_m = 0.002;

/// The lower borders of the facets of a building: where a facet ends, or two facets meet, and nothing goes on below.
///   (1) in the upright half-plane through any eye, outside of the building, each connected piece of it ends below on one of
///       them, or is connected with one that does not
///   (2) where a long edge meets a chain of shorter ones (a T-junction), the facets of both count
/// Which of them stand on the ground, and so show no sky below, is not known here.
[[nodiscard]] std::vector<HorizonSegment> undersides(std::span<const EdgeSides> edges);

}  // namespace farlod
