// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/reproject_gdal.hpp"

#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <memory>

#include "gdal/gdal_errors.hpp"
#include "points/requested_points.hpp"

namespace farlod {
namespace {

OGRSpatialReference read_crs(const std::string& definition) {
  OGRSpatialReference crs;
  if (crs.SetFromUserInput(definition.c_str()) != OGRERR_NONE)
    throw PointsError("the coordinate reference system of the points, \"" + definition +
                      "\", is not known; name it like EPSG:4326");
  if (crs.IsCompound() != 0) crs.StripVertical();  // heights are never shifted
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

/// As the user wrote it, unless that is the WKT of a file.
std::string name_of(const std::string& definition, const OGRSpatialReference& crs) {
  return definition.find('[') == std::string::npos || crs.GetName() == nullptr ? definition : crs.GetName();
}

std::string text_of(Point2d p) { return fmt::format("({}, {})", p.x, p.y); }

}  // namespace

std::vector<Point2d> reprojected(std::span<const Point2d> points, const std::string& from_crs, const std::string& to_crs) {
  const GdalErrors errors;
  const OGRSpatialReference from = read_crs(from_crs), to = read_crs(to_crs);
  const std::unique_ptr<OGRCoordinateTransformation> transformation(OGRCreateCoordinateTransformation(&from, &to));
  if (transformation == nullptr)
    throw PointsError("no way leads from " + name_of(from_crs, from) + " to " + name_of(to_crs, to) + ": " + errors.last());
  std::vector<Point2d> projected(points.begin(), points.end());
  for (std::size_t n = 0; n < projected.size(); ++n) {
    if (transformation->Transform(1, &projected[n].x, &projected[n].y) == 0)
      throw PointsError("point " + std::to_string(n + 1) + " at " + text_of(points[n]) + " cannot be projected from " +
                        name_of(from_crs, from) + "; x is the longitude or easting, y the latitude or northing");
  }
  return projected;
}

}  // namespace farlod
