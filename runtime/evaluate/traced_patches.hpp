// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <stop_token>

#include "evaluate/quantity_table.hpp"
#include "evaluate/sky_answers.hpp"
#include "farlod/point.hpp"
#include "farlod/shadow_patches.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "package/manifest.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The directions of the patches, of length 1, in the grid frame.
using PatchDirections = std::array<Point3f, shadow_patch_count>;
[[nodiscard]] PatchDirections patch_directions(const package::Manifest& manifest);

/// A scene of the whole city, and its crowns in the same frame.
struct PatchScene {
  PlacedScene solid;
  const CrownOccluder* crowns = nullptr;  ///< null where there are none
};

/// Stores the columns of Quantities::shadow_patches of the receivers of a cell, which are `columns` of so many, by a ray for each
/// patch. Throws Cancelled when `stop` is asked for.
void store_shadow_patches(const CellReceivers& cell, const PatchScene& scene, const PatchDirections& directions,
                          const ColumnRange& columns, std::size_t columns_in_all, const SkyAnswers& answers,
                          const std::stop_token& stop);

}  // namespace farlod
