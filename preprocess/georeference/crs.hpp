// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>

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

/// The area of use of a CRS. West is greater than east if it contains the antimeridian.
struct AreaOfUse {
  double west_deg = 0.0, south_deg = 0.0, east_deg = 0.0, north_deg = 0.0;

  [[nodiscard]] bool contains(Point2d lon_lat_deg) const { return contains(lon_lat_deg, 0.0, 0.0); }
  /// Whether a place lies in the area, widened on all sides by the margins.
  [[nodiscard]] bool contains(Point2d lon_lat_deg, double lon_margin_deg, double lat_margin_deg) const {
    const auto east_of_west = [this](double lon_deg) {
      const double d = std::fmod(lon_deg - west_deg, 360.0);
      return d < 0.0 ? d + 360.0 : d;
    };
    const double width_deg = east_deg - west_deg == 360.0 ? 360.0 : east_of_west(east_deg);
    const double d = east_of_west(lon_lat_deg.x);
    const bool in_longitude = d <= width_deg + lon_margin_deg || d >= 360.0 - lon_margin_deg;
    return in_longitude && south_deg - lat_margin_deg <= lon_lat_deg.y && lon_lat_deg.y <= north_deg + lat_margin_deg;
  }
};

/// A unit of the coordinates of maps.
struct LengthUnit {
  std::string name;       ///< as in the EPSG register
  double metres = 1.0;    ///< length of one unit
  std::string epsg_code;  ///< empty if the register has none
  std::string mark;       ///< the end of the names of CRSs in this unit in the register: " (ftUS)"
};

inline const LengthUnit metre{"metre", 1.0, "9001", ""};
inline const LengthUnit foot{"foot", 0.3048, "9002", " (ft)"};
inline const LengthUnit us_survey_foot{"US survey foot", 1200.0 / 3937.0, "9003", " (ftUS)"};

/// A horizontal coordinate reference system (CRS), geographic or projected. Of the vertical part of a definition, only the unit
/// and, by HeightShift, the name and the whole definition are used. In this class and in CrsTransformation, x is always the
/// easting or the longitude, and y the northing or the latitude; `northing_first` is the order of the authority. Not thread-safe.
class Crs {
 public:
  /// Empty when PROJ does not know the definition, or when the CRS is neither geographic nor projected.
  [[nodiscard]] static std::optional<Crs> find(const std::string& definition);

  [[nodiscard]] bool is_projected() const;
  /// The unit of the horizontal axes, in metres or radians.
  [[nodiscard]] double unit() const;
  /// The unit of heights, in metres: that of the vertical axis; without one, that of the horizontal axes of a projected CRS;
  /// else 1.
  [[nodiscard]] double height_unit_m() const;
  /// Whether the definition has a vertical axis.
  [[nodiscard]] bool says_height_unit() const;
  /// The vertical system of the definition: "DHHN2016 height", or "ellipsoidal heights of ETRS89". Empty when it has none.
  [[nodiscard]] std::optional<std::string> heights_name() const;
  /// WKT2:2019 of the definition with its vertical system. It must have one.
  [[nodiscard]] std::string whole_wkt() const;
  /// Whether the authority writes the northing or the latitude first.
  [[nodiscard]] bool northing_first() const;
  /// Whether the axes point east and north, in any order. Those of Lo (South Africa) and of polar stereographic CRSs do not.
  [[nodiscard]] bool runs_east_and_north() const;
  /// Whether the CRS is geographic in degrees from Greenwich, as the formulas of UTM require.
  [[nodiscard]] bool is_in_degrees_from_greenwich() const;
  [[nodiscard]] std::string name() const;
  /// The EPSG code of the CRS, or of an equal one in the EPSG register.
  [[nodiscard]] std::optional<int> epsg() const;
  /// WKT2:2019 in the axis order of the authority. If the EPSG register has the CRS, it is the WKT of that entry.
  [[nodiscard]] std::string wkt() const;
  [[nodiscard]] std::optional<AreaOfUse> area_of_use() const;
  /// The name of that area in the register: "Netherlands - onshore, including Waddenzee". Empty where it is not known.
  [[nodiscard]] std::string area_name() const;
  [[nodiscard]] Ellipsoid ellipsoid() const;
  /// The zone of a UTM projection in metres whose eastings have no zone number; else empty.
  [[nodiscard]] std::optional<UtmZone> utm_zone() const;
  /// The width of a zone of UTM and Gauss-Krüger projections; 0 for all others.
  [[nodiscard]] double zone_width_deg() const;
  [[nodiscard]] bool equals(const Crs& other) const;
  /// The longitude and latitude of a point on the ellipsoid of its datum, in degrees from Greenwich, without the shift to WGS 84,
  /// which may be some hundred metres. Empty if the point has none.
  [[nodiscard]] std::optional<Point2d> lon_lat_deg(Point2d p) const;
  /// The same with the shift to WGS 84, to within some metres where PROJ knows the shift.
  [[nodiscard]] std::optional<Point2d> wgs84_lon_lat_deg(Point2d p) const;

  /// The geographic CRS on which a projected one is based; of a geographic CRS, itself.
  [[nodiscard]] Crs geographic() const;
  /// The same projection in another unit: the entry of the register if there is one.
  [[nodiscard]] Crs counted_in(const LengthUnit& length) const;
  /// UTM on the datum of this geographic CRS.
  [[nodiscard]] Crs utm(UtmZone zone) const;

  struct Distortion {
    Angle convergence;                               ///< true azimuth = grid azimuth + convergence
    double least_scale = 1.0, greatest_scale = 1.0;  ///< length on the map over length on the Earth, over all directions
  };
  /// The distortion of a projected CRS at a point. Empty where the projection has no inverse.
  [[nodiscard]] std::optional<Distortion> distortion_at(Point2d p_projected) const;

 private:
  friend class CrsTransformation;
  struct Impl;
  explicit Crs(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Transforms coordinates from one CRS to another. One operation, chosen at `typical`, is used for the whole city, so that no
/// seam between two datum shifts runs through it. No grid is downloaded.
class CrsTransformation {
 public:
  CrsTransformation(const Crs& from, const Crs& to, Point2d typical);
  /// Does not change z. The x and y of points that cannot be transformed become infinite.
  void apply(std::span<Point3d> points) const;
  [[nodiscard]] std::optional<Point2d> apply(Point2d point) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// The entry of PROJ's registers with a name such as "ETRS89 / UTM zone 32N" or "Amersfoort / RD New + NAP height", as "EPSG:n"
/// or "EPSG:n+m". These names are found:
///   (1) names and aliases of the register, in upper or lower case
///   (2) the same letters and digits with other characters between them ("ETRS89_UTM_zone_32N", "WGS84 UTM 32N")
///   (3) a name without its datum ("RD New"), if only one name of the register ends with it
/// Empty when no entry has the name, or more than one.
[[nodiscard]] std::optional<std::string> code_of_crs_name(const std::string& name);

}  // namespace farlod::georeference
