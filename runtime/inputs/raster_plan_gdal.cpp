// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/raster_plan_gdal.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gdal/gdal_errors.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "inputs/reproject_gdal.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {
namespace {

/// The part of a pixel that files are off which were written with few digits.
constexpr double tolerance = 0.01;

GDALDatasetUniquePtr open_raster(const std::filesystem::path& file, const GdalErrors& errors) {
  if (!std::filesystem::exists(file)) throw PointsError(file.string() + ": the file cannot be read; see that it exists");
  GDALDatasetUniquePtr dataset = open_within(GdalReach::local_files, file, GDAL_OF_RASTER);
  if (dataset == nullptr)
    throw PointsError(file.string() + " cannot be read as a raster" + (errors.any() ? " (" + errors.last() + ")" : ""));
  return dataset;
}

RasterPlan plan_of(GDALDataset& dataset, const std::string& file) {
  // x = x0 + column · dx + row · shear, y = y0 + column · shear + row · dy (GDALDataset::GetGeoTransform)
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None)
    throw PointsError(file + " does not say where it lies: give it a geotransform, for instance by gdal_translate -a_ullr");
  const auto columns = static_cast<std::size_t>(dataset.GetRasterXSize()),
             rows = static_cast<std::size_t>(dataset.GetRasterYSize());
  const double widest = static_cast<double>(std::max(columns, rows)), step_m = g[1];
  const auto is_off = [&](double difference) { return !(std::abs(difference) * widest < tolerance * std::abs(step_m)); };
  if (!(step_m > 0.0) || is_off(g[2]) || is_off(g[4]) || is_off(g[5] + step_m))
    throw PointsError(file + " has pixels that are no squares, or do not lie north up: make them so with gdalwarp -tr STEP STEP");
  return {{g[0], g[3]}, step_m, columns, rows};
}

void require_same_crs(const RasterPlan& plan, const std::string& wkt, const std::string& package_crs_wkt,
                      const std::string& file) {
  const double width_m = static_cast<double>(plan.columns) * plan.step_m, height_m = static_cast<double>(plan.rows) * plan.step_m;
  const Point2d corner = plan.north_west_m;
  const std::vector<Point2d> corners{
      corner, {corner.x + width_m, corner.y}, {corner.x, corner.y - height_m}, {corner.x + width_m, corner.y - height_m}};
  const std::vector<Point2d> moved = reprojected(corners, wkt, package_crs_wkt);
  for (std::size_t n = 0; n < corners.size(); ++n)
    if (!(std::hypot(moved[n].x - corners[n].x, moved[n].y - corners[n].y) < tolerance * plan.step_m))
      throw PointsError(file +
                        " is in another CRS than the package: warp it (gdalwarp -t_srs), or pack the city in its CRS "
                        "(farlod-pack --out-crs)");
}

}  // namespace

RasterGrid read_raster_grid_gdal(const std::filesystem::path& file, const std::string& package_crs_wkt) {
  const GdalErrors errors;
  const GDALDatasetUniquePtr dataset = open_raster(file, errors);
  const RasterGrid grid{plan_of(*dataset, file.string()), dataset->GetSpatialRef() != nullptr};
  if (grid.says_crs) require_same_crs(grid.plan, wkt_of(dataset->GetSpatialRef()), package_crs_wkt, file.string());
  return grid;
}

}  // namespace farlod
