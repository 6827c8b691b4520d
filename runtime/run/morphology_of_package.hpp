// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "package/manifest.hpp"
#include "run/cell_amounts.hpp"

namespace farlod {

/// Throws InvalidArgument where a package cannot say what cells or zones have of buildings.
void require_buildings_cut_at_borders(const package::Manifest& m);

/// In the grid frame.
[[nodiscard]] WindDirections winds_of(const package::Manifest& m);

}  // namespace farlod
