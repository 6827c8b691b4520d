// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/city_scenery.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "app/problem_places.hpp"
#include "results/point_file.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

/// All cells, as large as a screen.
RasterPlan plan_of(const Package& package) {
  const Box2d& all = package.description().outline_projected;
  const double longer_m = std::max(all.high.x - all.low.x, all.high.y - all.low.y);
  return plan_raster(package, longer_m / static_cast<double>(wished_preview_edge), all);
}

GridLines grid_of(const Package& package, const PackageFacts& facts) {
  const PackageDescription& d = facts.description;
  const CellRectangle& cells = facts.inventory.cells;
  const auto corners = inspect_cell(package, {cells.i_begin, cells.j_begin}).corners_projected;
  const Point2d east = static_cast<double>(d.columns) * (corners[1] - corners[0]),
                north = static_cast<double>(d.rows) * (corners[3] - corners[0]);
  return {{corners[0], corners[0] + east, corners[0] + east + north, corners[0] + north}, d.columns, d.rows, d.cell_edge_m};
}

/// The middle of the city in WGS 84; empty without GDAL.
std::string place_of([[maybe_unused]] const PackageDescription& d) {
#ifdef FARLOD_WITH_GDAL
  const Point2d middle = 0.5 * (d.outline_projected.low + d.outline_projected.high);
  const Point2d degrees = gdal_files().reprojected({&middle, 1}, d.crs_wkt, "EPSG:4326").front();
  return fmt::format("latitude {:.4f}, longitude {:.4f}", degrees.y, degrees.x);
#else
  return "";
#endif
}

/// Degrees in the CRS of the package.
std::vector<Point2d> projected([[maybe_unused]] const std::vector<Point2d>& lon_lat,
                               [[maybe_unused]] const PackageDescription& d) {
#ifdef FARLOD_WITH_GDAL
  return gdal_files().reprojected(lon_lat, "EPSG:4326", d.crs_wkt);
#else
  throw InputError("this farlod-info is built without GDAL, and cannot bring degrees into the CRS of the package.");
#endif
}

MarkedPlaces places_in(const std::filesystem::path& report, const PackageDescription& d) {
  MarkedPlaces marked;
  if (report.empty()) return marked;
  marked.file = report.filename().string();
  if (const auto lon_lat = problem_places_in(report)) {
    marked.places_projected = projected(*lon_lat, d);
    return marked;
  }
  for (const RequestedPoint& p : read_points_in(d.crs_wkt, report).points) marked.places_projected.push_back({p.x, p.y});
  return marked;
}

}  // namespace

CityScenery city_scenery(const Package& package, const PackageFacts& facts, const std::filesystem::path& report,
                         const RunSettings& run) {
  const PackageDescription& d = facts.description;
  CityScenery scenery{plan_of(package), {},         grid_of(package, facts), places_in(report, d), facts.package,
                      crs_text(d),      place_of(d)};
  scenery.heights = plan_heights(package, scenery.plan, run);
  if (facts.inventory.crowns.all() > 0) scenery.crown_tops_m = plan_canopy(package, scenery.plan, run).top_m;
  scenery.is_surface_model = facts.pixels.has_value();
  return scenery;
}

}  // namespace farlod
