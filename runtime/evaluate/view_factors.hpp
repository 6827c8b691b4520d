// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "base/frame.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_directions.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "receivers/receiver.hpp"
#include "scene/seen_surfaces.hpp"

namespace farlod {

/// A scene of the whole city, what its triangles are, and its crowns in the same frame.
struct SeenScene {
  PlacedScene solid;
  const SeenSurfaces& surfaces;
  const CrownOccluder* crowns = nullptr;  ///< null where there are none
};

/// Stores the columns of Quantities::view_factors and ::view_factors_below of the receivers of a cell, whose svf is stored, by
/// rays in their directions. Rays say how the sky is divided among sky and crowns, and what hides it among classes, and the lower
/// half likewise; how large the three parts are tell svf and the receiver's normal, so that all add up to 1. A part that no ray
/// lies in is `other`, but for the sky. `weight` is that of svf and of the directions. Throws Cancelled when `stop` is asked for.
void store_view_factors(const CellReceivers& cell, const SeenScene& scene, const SkyDirections& directions, SkyWeight weight,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop);

/// So many directions in the grid frame, within ±`field_deg` of the horizontal and alike in solid angle.
[[nodiscard]] std::vector<Point3d> eye_directions(double field_deg, std::size_t count, const GridRotation& rotation);
/// Stores the columns of Quantities::view_eye of the receivers of a cell: shares of these directions.
void store_views_of_eye(const CellReceivers& cell, const SeenScene& scene, std::span<const Point3d> directions,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop);

}  // namespace farlod
