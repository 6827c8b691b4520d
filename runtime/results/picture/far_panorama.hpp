// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "farlod/inspection.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {

/// An upright rectangle of paper.
struct PageBox {
  PagePoint upper_left;
  double width = 0.0, height = 0.0;
};

/// A place as an observer sees it.
struct SeenPlace {
  double azimuth_deg = 0.0;  ///< true, from 0 up to 360
  double elevation_deg = 0.0;
};
[[nodiscard]] SeenPlace seen_from(const Point3d& eye_projected, const Point3d& p_projected, Angle convergence);

/// The largest elevation that a panorama of a far map shows, a multiple of 5°.
[[nodiscard]] double top_of_panorama_deg(const FarView& view, Angle convergence);

/// Where the column of a box's map lies that a direction meets, from 0 to 4 in sides, clockwise from the west end of the north
/// side.
[[nodiscard]] double place_along_sides(double true_azimuth_deg, const FarBoxView& map);

/// Draws a far map unfolded, with its axes and the four directions: the horizon by azimuth from north to north, or the four sides
/// of the box.
void add_far_panorama(Drawing& drawing, const PageBox& where, const FarView& view, Angle convergence);

/// What its colours mean, below a place. Returns the place below that.
[[nodiscard]] PagePoint add_panorama_legend(Drawing& drawing, PagePoint place, const FarView& view);

}  // namespace farlod
