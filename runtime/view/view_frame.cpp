// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_frame.hpp"

#include <cmath>
#include <optional>
#ifdef FARLOD_WITH_GDAL
#include "farlod/points.hpp"
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

constexpr EcefFromLocal unit_matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

#ifdef FARLOD_WITH_GDAL
/// Earth-centred coordinates of a place of WGS 84, in degrees and metres above the ellipsoid.
Point3d ecef_of(Point2d longitude_latitude_deg, double height_m) {
  constexpr double semi_major_m = 6378137.0, flattening = 1.0 / 298.257223563, e2 = flattening * (2.0 - flattening);
  const Angle lambda = Angle::degrees(longitude_latitude_deg.x), phi = Angle::degrees(longitude_latitude_deg.y);
  const double n = semi_major_m / std::sqrt(1.0 - e2 * sin(phi) * sin(phi));
  return {(n + height_m) * cos(phi) * cos(lambda), (n + height_m) * cos(phi) * sin(lambda),
          (n * (1.0 - e2) + height_m) * sin(phi)};
}

EcefFromLocal tangent_at(const Point3d& origin, const std::string& crs_wkt) {
  // Half of a step of 200 m to either side
  constexpr double half_step_m = 100.0;
  std::vector<Point2d> places{{origin.x, origin.y},
                              {origin.x - half_step_m, origin.y},
                              {origin.x + half_step_m, origin.y},
                              {origin.x, origin.y - half_step_m},
                              {origin.x, origin.y + half_step_m}};
  places = gdal_files().reprojected(places, crs_wkt, "EPSG:4326");
  const auto at = [&](std::size_t n) { return ecef_of(places[n], origin.z); };
  return similar_frame((0.5 / half_step_m) * (at(2) - at(1)), (0.5 / half_step_m) * (at(4) - at(3)), at(0));
}
#endif

}  // namespace

ViewFrame view_frame_of(const Package& package) {
  const PackageDescription& d = package.description();
  const PackageInventory inventory = inventory_of(package);
  const std::optional<HeightRange> heights = heights_of(package);
  const Box2d& outline = d.outline_projected;
  ViewFrame frame{
      .origin_projected = {std::round(0.5 * (outline.low.x + outline.high.x)), std::round(0.5 * (outline.low.y + outline.high.y)),
                           heights ? std::floor(heights->low_m) : inventory.height_origin_m},
      .grid_axes = GridAxes::turned_by(d.grid_bearing),
      .convergence = d.convergence,
      .cell_edge_m = d.cell_edge_m,
      .cells = inventory.cells,
      .corner_local = {}};
  // The grid is turned about the origin of the city frame
  const Point2d first{inventory.cells.i_begin * d.cell_edge_m, inventory.cells.j_begin * d.cell_edge_m};
  frame.corner_local =
      inventory.origin_m - horizontal(frame.origin_projected) + first.x * frame.grid_axes.x + first.y * frame.grid_axes.y;
  if (heights) {
    frame.low_local = heights->low_m - frame.origin_projected.z;
    frame.high_local = heights->high_m - frame.origin_projected.z;
  }
  return frame;
}

EcefFromLocal similar_frame(const Point3d& east, const Point3d& north, const Point3d& o) {
  // As far from the one as from the other, where they are not at right angles
  const Point3d e = normalized(east), n = normalized(north), between = normalized(e + n), across = normalized(e - n);
  const double scale = std::sqrt(norm(east) * norm(north));
  const Point3d x = (scale * std::sqrt(0.5)) * (between + across), y = (scale * std::sqrt(0.5)) * (between - across);
  const Point3d z = (1.0 / scale) * cross(x, y);
  return {x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, o.x, o.y, o.z, 1.0};
}

EcefFromLocal placed_on_globe([[maybe_unused]] const PackageDescription& description, [[maybe_unused]] const ViewFrame& frame) {
#ifdef FARLOD_WITH_GDAL
  try {
    if (!description.crs_wkt.empty()) return tangent_at(frame.origin_projected, description.crs_wkt);
  } catch (const PointsError&) {
    // A CRS of an engineer, say: the city is seen, and is nowhere on the globe
  }
#endif
  return unit_matrix;
}

}  // namespace farlod
