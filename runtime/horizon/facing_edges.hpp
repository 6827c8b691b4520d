// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "horizon/silhouette_edges.hpp"

namespace farlod {

/// For each edge its distance in the plan from the middle of a box of eyes, or less than 0 when it can be a silhouette for none
/// of them: may_be_silhouette (farlod/horizon/edge_facing.hpp) and a look at its height, as floats, sixteen edges at once.
///   (1) an edge that may_be_silhouette keeps is kept, unless no end rises over the box's floor
///   (2) others are kept by rounding alone
/// `distances_m` has as many places as the batches have lanes; those without an edge mean nothing.
void find_facing(std::span<const SilhouetteEdges::Batch> edges, EdgeRole role, const ReceiverBox& box, std::span<float> distances_m);

}  // namespace farlod
