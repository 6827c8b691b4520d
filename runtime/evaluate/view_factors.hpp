// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <vector>

#include "evaluate/further_quantities.hpp"
#include "evaluate/quantity_table.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_directions.hpp"
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

/// What the columns of Quantities::view_factors are, in the order of ViewClass.
void describe_views(const Quantities& quantities, std::vector<ColumnDescription>& columns);
/// The same below the horizontal, where no sky is.
void describe_views_below(const Quantities& quantities, std::vector<ColumnDescription>& columns);

/// Stores the columns of both of the receivers of a cell, whose svf is stored, by rays in their directions. Rays say how the sky
/// is divided among sky and crowns, and what hides it among classes, and the lower half likewise; how large the three parts are
/// tell svf and the receiver's normal, so that all add up to 1. A part that no ray lies in is `other`, but for the sky. Throws
/// Cancelled when `stop` is asked for.
void store_view_factors(const CellReceivers& cell, const SeenScene& scene, const SkyDirections& directions,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop);

}  // namespace farlod
