// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/region_of_package.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

Region region_of(const Box2d& box) { return Region({{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}}); }

Region region_in(const std::filesystem::path& file, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  return gdal_files().read_region(file, package.crs_wkt);
#else
  throw PointsError(file.string() + " needs GDAL, which this farlod-svf was built without: give --bbox in " + package.crs_name +
                    " instead of --mask.");
#endif
}

/// Nobody asks a city for boxes that are farther away.
constexpr double farthest_box_m = 100e3;

bool is_near_city(const Box2d& box, const PackageDescription& package) {
  const Box2d around = grown(package.outline_projected, farthest_box_m);
  return box.low.x <= around.high.x && around.low.x <= box.high.x && box.low.y <= around.high.y && around.low.y <= box.high.y;
}

bool may_be_degrees(const Box2d& box) {
  const auto is_on_globe = [](Point2d p) { return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 90.0; };
  constexpr double largest_deg = 5.0;  // no city is larger
  const Point2d size = box.high - box.low;
  return is_on_globe(box.low) && is_on_globe(box.high) && std::max(size.x, size.y) <= largest_deg;
}

/// The box around what longitudes and latitudes enclose, if it is one in the CRS of the package; its sides are curved there.
std::optional<Box2d> projected_from_degrees(const Box2d& degrees, const PackageDescription& package) {
  Box2d box;
#ifdef FARLOD_WITH_GDAL
  constexpr int steps = 16;
  const Point2d size = degrees.high - degrees.low;
  std::vector<Point2d> sides;
  for (int n = 0; n <= steps; ++n) {
    const double x = degrees.low.x + size.x * n / steps, y = degrees.low.y + size.y * n / steps;
    for (const Point2d p : {Point2d{x, degrees.low.y}, {x, degrees.high.y}, {degrees.low.x, y}, {degrees.high.x, y}})
      sides.push_back(p);
  }
  for (const Point2d p : gdal_files().reprojected_each(sides, "OGC:CRS84", package.crs_wkt)) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
    box.add(p);
  }
#endif
  const bool is_near = !box.empty() && is_near_city(box, package);
  return is_near ? std::optional(box) : std::nullopt;
}

/// Where the box and the city lie, for somebody who thinks in degrees.
std::string both_in_degrees(const Box2d& given, const PackageDescription& package) {
  Box2d city;
#ifdef FARLOD_WITH_GDAL
  const auto [low, high] = package.city_projected;
  const std::vector<Point2d> corners{low, {high.x, low.y}, high, {low.x, high.y}};
  for (const Point2d p : gdal_files().reprojected_each(corners, package.crs_wkt, "OGC:CRS84"))
    if (std::isfinite(p.x) && std::isfinite(p.y)) city.add(p);
#endif
  const auto text_of = [](const Box2d& box) {
    return fmt::format("from {:.4f}, {:.4f} to {:.4f}, {:.4f}", box.low.x, box.low.y, box.high.x, box.high.y);
  };
  if (city.empty()) return {};
  return fmt::format(" In degrees (longitude, latitude), --bbox goes {}, and the city {}.", text_of(given), text_of(city));
}

}  // namespace

std::optional<BoxInDegrees> take_degrees_of_bbox(SvfOptions& options, const PackageDescription& package) {
  if (!options.bbox_projected || !may_be_degrees(*options.bbox_projected) || is_near_city(*options.bbox_projected, package))
    return std::nullopt;
  const Box2d degrees = *options.bbox_projected;
  const std::string given =
      fmt::format("{:.10g}, {:.10g}, {:.10g}, {:.10g}", degrees.low.x, degrees.low.y, degrees.high.x, degrees.high.y);
  if (const std::optional<Box2d> box = projected_from_degrees(degrees, package)) {
    options.bbox_projected = box;
    return BoxInDegrees{
        fmt::format("--bbox {} was taken for longitude and latitude (WGS 84): {:.0f}, {:.0f} to {:.0f}, {:.0f} in {}.", given,
                    box->low.x, box->low.y, box->high.x, box->high.y, package.crs_name),
        both_in_degrees(degrees, package)};
  }
  const Box2d exchanged{{degrees.low.y, degrees.low.x}, {degrees.high.y, degrees.high.x}};
  if (may_be_degrees(exchanged) && projected_from_degrees(exchanged, package))
    throw PointsError("--bbox " + given + " lies more than 100 km from the city: give the longitude before the latitude.");
  return BoxInDegrees{{}, both_in_degrees(degrees, package)};
}

std::shared_ptr<const Region> region_of_package(const SvfOptions& options, const PackageDescription& package) {
  if (!options.mask_file.empty()) return std::make_shared<const Region>(region_in(options.mask_file, package));
  if (options.source == ReceiverSource::grid || !options.bbox_projected) return nullptr;
  return std::make_shared<const Region>(region_of(*options.bbox_projected));
}

}  // namespace farlod
