// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/point_file.hpp"

#include <tuple>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "inputs/point_reader.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {

bool is_point_table(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

RequestedPoints read_point_file(const std::filesystem::path& file, const std::string& layer, [[maybe_unused]] bool may_be_empty) {
#ifdef FARLOD_WITH_GDAL
  if (!is_point_table(file) && gdal_files().is_vector_file(file)) return gdal_files().read_points(file, layer, may_be_empty);
#else
  if (const std::string ending = lower_case(file.extension().string());
      ending == ".gpkg" || ending == ".geojson" || ending == ".shp" || ending == ".fgb")
    throw PointsError(file.string() + " needs GDAL, which this program was built without: give the points as CSV.");
#endif
  if (!layer.empty()) throw PointsError(file.string() + " is a table: it has no layers (--points-layer)");
  return read_points_csv(file);
}

namespace {

RequestedPoints with_places_alone(RequestedPoints read) {
  std::vector<std::size_t> placed;
  for (std::size_t n = 0; n < read.points.size(); ++n)
    if (read.points[n].has_place()) placed.push_back(n);
  if (placed.size() == read.points.size()) return read;
  read.attributes = read.attributes.rows(placed);
  std::erase_if(read.points, [](const RequestedPoint& p) { return !p.has_place(); });
  return read;
}

}  // namespace

RequestedPoints read_points_in([[maybe_unused]] const std::string& crs_wkt, const std::filesystem::path& file) {
  RequestedPoints read = with_places_alone(read_point_file(file, "", true));
#ifdef FARLOD_WITH_GDAL
  if (read.crs_wkt.value_or("").empty()) return read;
  std::vector<Point2d> places;
  for (const RequestedPoint& p : read.points) places.push_back({p.x, p.y});
  places = gdal_files().reprojected_of_file(places, *read.crs_wkt, crs_wkt, {file, advice_to_say_crs(file)});
  for (std::size_t n = 0; n < places.size(); ++n)
    std::tie(read.points[n].x, read.points[n].y) = std::pair(places[n].x, places[n].y);
#endif
  return read;
}

}  // namespace farlod
