// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "results/picture/cell_plan.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {

/// What a picture of a cell shows.
struct CellScenery {
  CellContents contents;
  std::vector<MeshPart> around;  ///< the geometry of cells_of_plan()
  std::optional<BuildingOutlines> outlines;
  std::optional<FarView> far;
  Angle convergence;
  std::string package, crs;  ///< as the captions call them
};

/// Pixels along the edge of the plan.
inline constexpr std::size_t cell_plan_edge = 700;

/// The neighborhood from above, beside it the far map unfolded, and what the cell holds.
[[nodiscard]] Drawing draw_cell(const CellScenery& scenery);

}  // namespace farlod
