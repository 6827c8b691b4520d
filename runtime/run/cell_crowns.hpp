// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "farlod/morphology.hpp"
#include "package/package_reader.hpp"
#include "run/cell_faces.hpp"
#include "run/zone_plan.hpp"

namespace farlod {

/// The crowns over a cell, whose faces are given: their plan area along lines 10 cm apart. None of a package without crowns.
/// With trapezoids (cell frame), of what lies in these.
[[nodiscard]] std::optional<CellVegetation> vegetation_of(const PackageReader& package, Cell cell, const CellFaces& faces,
                                                          const std::vector<ZoneTrapezoid>* within = nullptr);

}  // namespace farlod
