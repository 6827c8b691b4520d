// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "app/evaluation.hpp"
#include "receivers/point_reader.hpp"
#include "results/sky_table_csv.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/reproject_gdal.hpp"
#endif

namespace farlod {
namespace {

struct NamedPlaces {
  std::vector<PlaceOfReceiver> places;
  std::vector<std::string> ids;
};

void move_to_package_crs(std::vector<PlaceOfReceiver>& places, [[maybe_unused]] const SvfOptions& options,
                         [[maybe_unused]] const package::Manifest& manifest) {
#ifdef FARLOD_WITH_GDAL
  std::vector<Point2d> points;
  for (const PlaceOfReceiver& p : places) points.push_back(p.p_projected);
  points = to_projected(points, options.points_crs, manifest.crs_wkt);
  for (std::size_t n = 0; n < places.size(); ++n) places[n].p_projected = points[n];
#else
  throw PointsError("--points-crs needs GDAL, which this farlod-svf was built without: give the points in the package's CRS (" +
                    manifest.crs_name + ").");
#endif
}

/// No map is as large, and no place on it as high or as low. Beyond, a cell has no number.
void require_on_earth(const NamedPlaces& named) {
  constexpr double farthest_m = 1e8, highest_m = 1e5;
  for (std::size_t n = 0; n < named.places.size(); ++n) {
    const auto& [p, height_m] = named.places[n];
    if (std::max(std::abs(p.x), std::abs(p.y)) > farthest_m || std::abs(height_m.value_or(0.0)) > highest_m)
      throw PointsError("point " + named.ids[n] + " lies nowhere on Earth: check its coordinates, and its CRS (--points-crs)");
  }
}

NamedPlaces read_places(const SvfOptions& options, const package::Manifest& manifest) {
  if (options.source == ReceiverSource::at) return {{options.at}, {"1"}};
  NamedPlaces result;
  for (RequestedPoint& point : read_points_csv(options.points_file)) {
    result.places.push_back({{point.x, point.y}, point.z});
    result.ids.push_back(std::move(point.id));
  }
  if (!options.points_crs.empty()) move_to_package_crs(result.places, options, manifest);
  return result;
}

}  // namespace

SvfRun run_points(const Package& package, const SvfOptions& options) {
  const NamedPlaces named = read_places(options, package.manifest());
  require_on_earth(named);
  const auto cells = places_by_cell(package, named.places);
  AnswerTable answers(named.places.size(), options.bounds);
  // Where a receiver stands is known once its cell is read
  std::vector<std::optional<double>> height_m(named.places.size());
  SvfRun run;
  const auto receivers_of = [&](std::size_t n) {
    CellReceivers r = receivers_at(package, cells[n].first, named.places, cells[n].second, options.height_above,
                                   static_cast<float>(options.height_m));
    for (const Receiver& receiver : r.receivers)
      height_m[receiver.index] = receiver.p_cell.z + package.manifest().height_origin_m;
    return r;
  };
  evaluate_cells(package, options, cells.size(), receivers_of, answers, run);
  run.inside_buildings = answers.svf.size() - run.receivers;
  std::vector<PointRow> rows;
  for (std::size_t n = 0; n < answers.svf.size(); ++n)
    rows.push_back({named.ids[n], named.places[n].p_projected, height_m[n], AnswerTable::value(answers.svf, n),
                    AnswerTable::value(answers.low, n), AnswerTable::value(answers.high, n)});
  const auto start = std::chrono::steady_clock::now();
  write_points_csv(rows, quantity_name(options.sky.weight), options.bounds ? BoundsColumns::yes : BoundsColumns::no,
                   options.output);
  run.files.push_back(options.output);
  run.seconds.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace farlod
