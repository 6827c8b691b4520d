// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/grid.hpp"
#include "farlod/morphology.hpp"
#include "package/package_reader.hpp"
#include "run/cell_faces.hpp"

namespace farlod {

/// The crowns over a cell, whose faces are given: their plan area along lines 10 cm apart. None of a package without crowns.
[[nodiscard]] std::optional<CellVegetation> vegetation_of(const PackageReader& package, Cell cell, const CellFaces& faces);

}  // namespace farlod
