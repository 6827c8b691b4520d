// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "generator/building_plan.hpp"
#include "generator/solid_builder.hpp"

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

/// Builds the solid of a plan with a gabled or hipped roof. Where the roof has an overhang, its planes continue beyond the walls
/// and below the eaves, as sheets without thickness that touch no wall; the solid is not closed then. The roof of an L projects
/// over all its eaves by the smallest of their overhangs.
void raise_pitched(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs);

}  // namespace farlod
