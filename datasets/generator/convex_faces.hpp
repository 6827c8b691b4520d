// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

using FaceRing = std::vector<std::uint32_t>;

/// Cuts a facet into convex faces without holes, for formats that have no others.
///   (1) no corner is added and edges of the facet stay whole, so that the faces of a closed solid are closed
///   (2) the faces have the normal of the facet
/// Handles the facets of the generator: rings with a hole of as many corners, hexagons with one re-entrant corner, and rings with
/// openings, which become triangles.
[[nodiscard]] std::vector<FaceRing> convex_faces(const GeneratedFacet& facet, std::span<const PointMm> vertices);

}  // namespace farlod
