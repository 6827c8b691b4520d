// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/points.hpp"

namespace farlod {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Receivers, coordinate by coordinate.
struct ReceiverColumns {
  std::vector<double> x_m, y_m, z_m;
  std::vector<Angle> azimuth, tilt;

  void add_on_ground(const Point3d& p_projected) { add({p_projected.x, p_projected.y, none}, Angle{}, Angle{}); }
  void add_on_surface(const Point3d& p_projected, const Point3d& normal, Angle convergence) {
    const Angle bearing = Angle::radians(std::atan2(normal.x, normal.y)) + convergence;
    add(p_projected + receiver_offset_m * normal, bearing, Angle::radians(std::acos(std::clamp(normal.z, -1.0, 1.0))));
  }
  [[nodiscard]] std::vector<float> values(const Package& package, std::size_t azimuths) const {
    if (x_m.empty()) return {};
    EvaluationSettings settings;
    settings.azimuths = azimuths;
    return evaluate_points(package, {x_m, y_m, z_m, azimuth, tilt}, {}, settings).svf;
  }

 private:
  void add(const Point3d& p, Angle bearing, Angle inclination) {
    x_m.push_back(p.x);
    y_m.push_back(p.y);
    z_m.push_back(p.z);
    azimuth.push_back(bearing);
    tilt.push_back(inclination);
  }
};

bool is_ground(const TileSurfaces& surfaces, const TileFacet& facet) {
  return surfaces.features[facet.feature].kind == SurfaceKind::ground;
}

/// Looks at facets of the ground without a value nearer to their corners.
void fill_edges_of_buildings(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces, std::size_t azimuths,
                             std::vector<float>& values) {
  constexpr double share = 0.6;
  std::vector<std::size_t> facets;
  ReceiverColumns receivers;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const TileFacet& facet = surfaces.facets[n];
    if (!std::isnan(values[n]) || !is_ground(surfaces, facet)) continue;
    facets.push_back(n);
    for (const Point3d& corner : facet.corners_local)
      receivers.add_on_ground(frame.projected_from_local(facet.middle_local + share * (corner - facet.middle_local)));
  }
  const std::vector<float> further = receivers.values(package, azimuths);
  for (std::size_t n = 0; n < facets.size(); ++n) {
    float sum = 0.0F, count = 0.0F;
    for (std::size_t k = 3 * n; k < 3 * n + 3; ++k)
      if (!std::isnan(further[k])) sum += further[k], count += 1.0F;
    if (count > 0.0F) values[facets[n]] = sum / count;
  }
}

}  // namespace

std::vector<float> values_of(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces, std::size_t azimuths) {
  ReceiverColumns receivers;
  for (const TileFacet& facet : surfaces.facets) {
    const Point3d p = frame.projected_from_local(facet.middle_local);
    if (is_ground(surfaces, facet))
      receivers.add_on_ground(p);
    else
      receivers.add_on_surface(p, facet.normal, frame.convergence);
  }
  std::vector<float> values = receivers.values(package, azimuths);
  fill_edges_of_buildings(package, frame, surfaces, azimuths, values);
  return values;
}

}  // namespace farlod
