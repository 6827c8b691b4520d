// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "generator/generated_building.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// How far the roof projects over each edge of `footprint_ring`, in metres; a rectangle uses the first four.
using Overhangs = std::array<double, 6>;

/// A rectangle turned so that the ridge runs along its first edge, in the lot's frame.
struct RidgeFrame {
  std::array<Point2d, 4> c;
  std::array<double, 4> overhang_m;  ///< over each of its edges
  Point2d along, across;             ///< unit vectors along the first edge, and from it to the opposite one
};
[[nodiscard]] RidgeFrame ridge_frame(const BuildingPlan& plan, const Overhangs& overhangs);

/// Raises a plan to a solid on `ground_m`. With `lod` 1 it is a prism with a flat top at half the height of its roof. The solid
/// is closed, unless its roof overhangs.
[[nodiscard]] PlanSolid raise(const BuildingPlan& plan, double ground_m, int lod, const Overhangs& overhangs = {});

}  // namespace farlod
