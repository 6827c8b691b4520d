// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// The way from one CRS to another, each named by a code ("EPSG:4326") or as WKT. In both, x is the easting or the longitude and
/// y the northing or the latitude, whatever axis order the CRS declares. Degrees stay degrees; heights are not moved.
class Reprojection {
 public:
  /// Throws PointsError when a CRS is not known, or no way leads from one to the other.
  Reprojection(const std::string& from_crs, const std::string& to_crs);
  Reprojection(Reprojection&&) noexcept;
  ~Reprojection();
  /// Moves the points; returns the number of the first one that cannot be moved, if there is any.
  [[nodiscard]] std::optional<std::size_t> apply(std::span<Point2d> points) const;
  /// Moves all points; those that cannot be moved become NaN.
  void apply_each(std::span<Point2d> points) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Takes points from a CRS that the user names ("EPSG:4326", WKT, …) into another one. In both, x is the easting or the
/// longitude and y the northing or the latitude, whatever axis order the CRS declares. Degrees stay degrees.
/// Throws PointsError when a CRS is not known or a point cannot be projected; it names the point by its number from 1.
[[nodiscard]] std::vector<Point2d> reprojected(std::span<const Point2d> points, const std::string& from_crs,
                                               const std::string& to_crs);
/// A file of places, and what to do where they are in another CRS than it says.
struct PlacesOfFile {
  std::filesystem::path file;
  std::string advice;
};
/// The same of places of a file: names it, says where its CRS is that of GeoJSON without one, and gives the advice.
[[nodiscard]] std::vector<Point2d> reprojected_of_file(std::span<const Point2d> points, const std::string& from_crs,
                                                       const std::string& to_crs, const PlacesOfFile& places);
/// What to do where --points-crs names the CRS of places, or might.
[[nodiscard]] inline const char* advice_on_points_crs(bool is_given) {
  return is_given ? "check --points-crs, and that x is the longitude or easting"
                  : "name the CRS of its coordinates by --points-crs EPSG:n";
}
/// What to do where no option names the CRS of a file.
[[nodiscard]] inline std::string advice_to_say_crs(const std::filesystem::path& file) {
  return "say the CRS of its coordinates, by ogr2ogr -a_srs EPSG:n NEW.gpkg " + file.string();
}
/// The same, but points that cannot be projected become NaN.
[[nodiscard]] std::vector<Point2d> reprojected_each(std::span<const Point2d> points, const std::string& from_crs,
                                                    const std::string& to_crs);

}  // namespace farlod
