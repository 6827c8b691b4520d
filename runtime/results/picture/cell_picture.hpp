// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {

/// Where a place of the plan belongs to, seen from a cell.
enum class CellZone { cell, near, far };

[[nodiscard]] Colour building_colour(CellZone zone);
[[nodiscard]] Colour street_colour(CellZone zone);

/// The neighborhood of a cell and the ring of cells around it.
[[nodiscard]] CellRectangle cells_of_plan(const CellContents& contents);

/// Places of a cell's plan on a square of paper: north up, all of `cells_of_plan` within it, the cell in the middle.
class CellPlanFrame {
 public:
  CellPlanFrame(const CellContents& contents, std::size_t edge);

  [[nodiscard]] std::size_t edge() const { return edge_; }
  [[nodiscard]] double metres_per_pixel() const { return metres_per_pixel_; }
  /// In pixels from the upper left corner of the square.
  [[nodiscard]] PagePoint place_of(Point2d p_projected) const;
  /// The corner of cells, i and j counted from the cell's own south-west corner.
  [[nodiscard]] PagePoint corner(std::int32_t i, std::int32_t j) const;
  /// What the square shows, in the CRS.
  [[nodiscard]] Box2d part() const;

 private:
  Point2d corner_m_, east_m_, north_m_;  ///< the cell's south-west corner, and its sides from there
  std::size_t edge_;
  double metres_per_pixel_ = 1.0;
};

/// Streets and buildings from above, pixel by pixel.
[[nodiscard]] Picture draw_cell_plan(const CellContents& contents, const std::vector<MeshPart>& around,
                                     const CellPlanFrame& frame);

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
