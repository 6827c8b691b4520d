// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "view/tile_surfaces.hpp"

namespace farlod {

/// A tile as binary glTF 2.0, as 3D Tiles 1.1 have it: y up, around the middle of the tile's facets. Facets with a value are the
/// first primitive: its colours are those of a ramp texture at u = svf, and `_SVF` is the value. Those without are the second
/// one, grey.
/// `_FEATURE_ID_0` is the number of a facet's surface in a property table (EXT_mesh_features, EXT_structural_metadata) with
/// `building`, `surface` and `kind`. `svf` has a value for each facet, NaN for none. Empty surfaces are an empty scene.
[[nodiscard]] std::string glb_of(const TileSurfaces& surfaces, std::span<const float> svf);

}  // namespace farlod
