// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/reproject_gdal.hpp"

#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>

#include "base/lower_case.hpp"
#include "gdal/gdal_errors.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {
namespace {

OGRSpatialReference crs_called(const std::string& definition) {
  OGRSpatialReference crs;
  if (crs.SetFromUserInput(definition.c_str()) != OGRERR_NONE) {
    const bool is_code = !definition.empty() && definition.find_first_not_of("0123456789") == std::string::npos;
    throw PointsError("the coordinate reference system of the points, \"" + definition +
                      "\", is not known; name it like EPSG:" + (is_code ? definition : "32632"));
  }
  if (crs.IsCompound() != 0) crs.StripVertical();  // heights are never shifted
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

/// As the user wrote it, unless that is the WKT of a file.
std::string name_of(const std::string& definition, const OGRSpatialReference& crs) {
  return definition.find('[') == std::string::npos || crs.GetName() == nullptr ? definition : crs.GetName();
}

std::string text_of_refused(std::span<const Point2d> points, std::size_t refused, const std::string& from_crs) {
  return fmt::format("point {} at ({}, {}) cannot be projected from {}", refused + 1, points[refused].x, points[refused].y,
                     name_of(from_crs, crs_called(from_crs)));
}

/// Whether a CRS is that of RFC 7946, by the file's own word or silence.
bool is_of_geojson(const std::filesystem::path& file, const std::string& crs) {
  const std::string ending = lower_case(file.extension().string());
  const bool is_geojson = ending == ".geojson" || ending == ".geojsonl" || ending == ".json";
  return is_geojson && name_of(crs, crs_called(crs)) == "WGS 84";
}

}  // namespace

struct Reprojection::Impl {
  std::unique_ptr<OGRCoordinateTransformation> transformation;
};

Reprojection::Reprojection(const std::string& from_crs, const std::string& to_crs) : impl_(std::make_unique<Impl>()) {
  const GdalErrors errors;
  const OGRSpatialReference from = crs_called(from_crs), to = crs_called(to_crs);
  impl_->transformation.reset(OGRCreateCoordinateTransformation(&from, &to));
  if (impl_->transformation == nullptr)
    throw PointsError("no way leads from " + name_of(from_crs, from) + " to " + name_of(to_crs, to) + ": " + errors.last());
}

Reprojection::Reprojection(Reprojection&&) noexcept = default;
Reprojection::~Reprojection() = default;

void Reprojection::apply_each(std::span<Point2d> points) const {
  const GdalErrors errors;
  std::vector<double> x, y;
  for (const Point2d p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  std::vector<int> is_good(points.size());
  impl_->transformation->Transform(static_cast<int>(points.size()), x.data(), y.data(), nullptr, is_good.data());
  for (std::size_t n = 0; n < points.size(); ++n)
    points[n] = is_good[n] == 0 ? Point2d{std::nan(""), std::nan("")} : Point2d{x[n], y[n]};
}

std::optional<std::size_t> Reprojection::apply(std::span<Point2d> points) const {
  std::vector<Point2d> moved(points.begin(), points.end());
  apply_each(moved);
  const auto refused = std::ranges::find_if(moved, [](Point2d p) { return std::isnan(p.x); });
  std::copy(moved.begin(), refused, points.begin());
  return refused == moved.end() ? std::nullopt : std::optional(static_cast<std::size_t>(refused - moved.begin()));
}

std::vector<Point2d> reprojected_each(std::span<const Point2d> points, const std::string& from_crs, const std::string& to_crs) {
  const Reprojection reprojection(from_crs, to_crs);
  std::vector<Point2d> projected(points.begin(), points.end());
  reprojection.apply_each(projected);
  return projected;
}

std::vector<Point2d> reprojected(std::span<const Point2d> points, const std::string& from_crs, const std::string& to_crs) {
  std::vector<Point2d> projected(points.begin(), points.end());
  if (const auto refused = Reprojection(from_crs, to_crs).apply(projected))
    throw PointsError(text_of_refused(points, *refused, from_crs) +
                      "; x is the longitude or easting, y the latitude or northing");
  return projected;
}

std::vector<Point2d> reprojected_of_file(std::span<const Point2d> points, const std::string& from_crs, const std::string& to_crs,
                                         const PlacesOfFile& places) {
  std::vector<Point2d> projected(points.begin(), points.end());
  const auto refused = Reprojection(from_crs, to_crs).apply(projected);
  if (!refused) return projected;
  const char* of_geojson =
      is_of_geojson(places.file, from_crs) ? " (degrees), the CRS of GeoJSON that names none (RFC 7946)" : "";
  throw PointsError(places.file.string() + ": " + text_of_refused(points, *refused, from_crs) + of_geojson + ": " +
                    places.advice);
}

}  // namespace farlod
