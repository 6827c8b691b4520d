// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "farlod/angle.hpp"
#include "farlod/point.hpp"

namespace farlod::georeference {

struct Ellipsoid {
  double semi_major_m = 0.0;
  double inverse_flattening = 0.0;  ///< 0 for a sphere
};

struct UtmZone {
  int number = 0;  ///< 1 to 60
  bool north = true;
  bool operator==(const UtmZone&) const = default;
};

/// The UTM zone of a place, with the exceptions of Norway and Svalbard; near the poles, the zone of its longitude.
[[nodiscard]] UtmZone utm_zone_of(Point2d lon_lat_deg);

/// UTM on the ellipsoid of the datum of the coordinates, without a datum shift.
///   (1) accurate to nanometres within the zone and its neighbors (Karney 2011, series of order 6)
///   (2) a point that is not finite, or more than 500 km from the meridian of the zone, where UTM ends, has no projection
class UtmProjection {
 public:
  UtmProjection(UtmZone zone, Ellipsoid ellipsoid) : zone_(zone), ellipsoid_(ellipsoid) {}

  [[nodiscard]] std::optional<Point2d> projected(Point2d lon_lat_deg) const;
  [[nodiscard]] Point2d lon_lat_deg(Point2d p_projected) const;
  /// Meridian convergence γ: true azimuth = grid azimuth + γ.
  [[nodiscard]] Angle convergence_at(Point2d p_projected) const;

 private:
  UtmZone zone_;
  Ellipsoid ellipsoid_;
};

}  // namespace farlod::georeference
