// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
/// The same, but points that cannot be projected become NaN.
[[nodiscard]] std::vector<Point2d> reprojected_each(std::span<const Point2d> points, const std::string& from_crs,
                                                    const std::string& to_crs);

}  // namespace farlod
