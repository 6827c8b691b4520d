// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

using FaceRing = std::vector<std::uint32_t>;

/// Cuts a facet into convex faces without holes, for formats that know no others.
///   (1) no corner is added, and edges of the facet stay whole: the faces of a closed solid are closed again
///   (2) the faces look the same way as the facet
/// Serves what the generator makes: a ring with a hole of as many corners, hexagons with one re-entrant corner, and rings with
/// openings, which become triangles.
[[nodiscard]] std::vector<FaceRing> convex_faces(const GeneratedFacet& facet, std::span<const PointMm> vertices);

}  // namespace farlod
