// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stop_token>

#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "farlod/evaluation.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "receivers/receiver.hpp"
#include "scene/seen_building.hpp"

namespace farlod {

/// A scene of the whole city, a building of it, and its crowns in the same frame.
struct BuildingScene {
  PlacedScene solid;
  const SeenBuilding& building;
  const CrownOccluder* crowns = nullptr;  ///< null where there are none
};

/// How a building is looked for.
struct BuildingLook {
  std::size_t rays = 0;  ///< of a receiver, all towards the building
  SkyWeight weight = SkyWeight::cosine;
  bool on_surfaces = false;  ///< what lies behind a receiver is the surface that it stands on
};

/// Stores the columns of Quantities::seen_building of the receivers of a cell. Rays go to the window that the box of the building
/// fills, so that one that is far away is met by as many as one nearby. Throws Cancelled when `stop` is asked for.
void store_building_views(const CellReceivers& cell, const BuildingScene& scene, const BuildingLook& look,
                          const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop);

}  // namespace farlod
