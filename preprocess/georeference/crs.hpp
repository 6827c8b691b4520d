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
#include "georeference/utm_projection.hpp"

namespace farlod::georeference {

/// Where a CRS is meant to be used. Its west may be greater than its east, across the antimeridian.
struct AreaOfUse {
  double west_deg = 0.0, south_deg = 0.0, east_deg = 0.0, north_deg = 0.0;

  [[nodiscard]] bool contains(Point2d lon_lat_deg) const { return contains(lon_lat_deg, 0.0, 0.0); }
  /// The same of the area widened to all sides.
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

/// A unit that maps count in.
struct LengthUnit {
  std::string name;       ///< in EPSG's words
  double metres = 1.0;    ///< of one unit
  std::string epsg_code;  ///< empty where the register has none
  std::string mark;       ///< how the register ends the names of CRSs in this unit: " (ftUS)"
};

inline const LengthUnit metre{"metre", 1.0, "9001", ""};
inline const LengthUnit foot{"foot", 0.3048, "9002", " (ft)"};
inline const LengthUnit us_survey_foot{"US survey foot", 1200.0 / 3937.0, "9003", " (ftUS)"};

/// A horizontal coordinate reference system, geographic or projected. What a definition says of heights is kept only as
/// their unit: heights are never shifted from one vertical datum to another.
/// In this class and in CrsTransformation x is always the easting or the longitude, y the northing or the latitude;
/// `northing_first` tells what the authority's order is. Not for several threads at once.
class Crs {
 public:
  /// Empty when PROJ does not know the definition, or when it is neither geographic nor projected.
  [[nodiscard]] static std::optional<Crs> find(const std::string& definition);

  [[nodiscard]] bool is_projected() const;
  /// Metres or radians for one unit of the horizontal axes.
  [[nodiscard]] double unit() const;
  /// Metres for one unit of height: of the vertical axis; without one, of a projected CRS's horizontal axes; else 1.
  [[nodiscard]] double height_unit_m() const;
  /// The definition has a vertical axis.
  [[nodiscard]] bool says_height_unit() const;
  /// The authority writes the northing or the latitude first.
  [[nodiscard]] bool northing_first() const;
  /// The axes run east and north, in whichever order (not so: Lo of South Africa, polar stereographic).
  [[nodiscard]] bool runs_east_and_north() const;
  /// Geographic in degrees from Greenwich: what a formula for UTM expects.
  [[nodiscard]] bool is_in_degrees_from_greenwich() const;
  [[nodiscard]] std::string name() const;
  /// The code of the CRS itself, or of its equal in the EPSG register.
  [[nodiscard]] std::optional<int> epsg() const;
  /// WKT2:2019 in the authority's own axis order; of the EPSG register's entry where there is one.
  [[nodiscard]] std::string wkt() const;
  [[nodiscard]] std::optional<AreaOfUse> area_of_use() const;
  [[nodiscard]] Ellipsoid ellipsoid() const;
  /// The zone, if the projection is UTM in metres, without a zone number before the easting.
  [[nodiscard]] std::optional<UtmZone> utm_zone() const;
  /// Of projections cut into zones along meridians, UTM and Gauss-Krüger: how wide a zone is; else 0.
  [[nodiscard]] double zone_width_deg() const;
  [[nodiscard]] bool equals(const Crs& other) const;
  /// Where a point is on the datum's own ellipsoid, in degrees from Greenwich: a shift to WGS 84, of up to some hundred metres,
  /// is left out. Empty for what is nowhere.
  [[nodiscard]] std::optional<Point2d> lon_lat_deg(Point2d p) const;

  /// The geographic CRS below a projected one; a geographic one itself.
  [[nodiscard]] Crs geographic() const;
  /// The same projection counted in another unit; the register's own twin where there is one.
  [[nodiscard]] Crs counted_in(const LengthUnit& length) const;
  /// UTM on the datum of this geographic CRS.
  [[nodiscard]] Crs utm(UtmZone zone) const;

  struct Distortion {
    Angle convergence;                               ///< true azimuth = grid azimuth + convergence
    double least_scale = 1.0, greatest_scale = 1.0;  ///< metres on the map for one on the Earth, by direction
  };
  /// How a projected CRS bends the Earth at a point of it. Empty where it has no inverse.
  [[nodiscard]] std::optional<Distortion> distortion_at(Point2d p_projected) const;

 private:
  friend class CrsTransformation;
  struct Impl;
  explicit Crs(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Coordinates of one CRS in another. One operation serves the whole city, chosen for `typical`, so that no seam between
/// two datum shifts runs through it. No grid is ever fetched from the network.
class CrsTransformation {
 public:
  CrsTransformation(const Crs& from, const Crs& to, Point2d typical);
  /// Leaves z alone. What cannot be transformed becomes infinite.
  void apply(std::span<Point3d> points) const;
  [[nodiscard]] std::optional<Point2d> apply(Point2d point) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace farlod::georeference
