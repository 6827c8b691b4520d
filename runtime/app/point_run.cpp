// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "app/evaluation.hpp"
#include "app/memory_limit.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/point_reader.hpp"
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
  NamedPlaces result;
  if (options.source == ReceiverSource::at) {
    result = {{options.at}, {"1"}};
  } else {
    for (RequestedPoint& point : read_points_csv(options.points_file)) {
      result.places.push_back({{point.x, point.y}, point.z});
      result.ids.push_back(std::move(point.id));
    }
  }
  if (!options.points_crs.empty()) move_to_package_crs(result.places, options, manifest);
  require_on_earth(result);
  return result;
}

using PlacesByCell = std::vector<std::pair<Cell, std::vector<std::size_t>>>;

PlacesByCell places_along_curve(const Package& package, std::span<const PlaceOfReceiver> places) {
  std::map<Cell, std::vector<std::size_t>> by_cell;
  std::vector<Cell> cells;
  for (auto& [cell, chosen] : places_by_cell(package, places)) {
    cells.push_back(cell);
    by_cell[cell] = std::move(chosen);
  }
  PlacesByCell result;
  for (const Cell cell : along_hilbert_curve(std::move(cells), package.grid().block_edge))
    result.emplace_back(cell, std::move(by_cell[cell]));
  return result;
}

MemoryNeeds needs_of(const Package& package, const NamedPlaces& named, const PlacesByCell& cells) {
  // A point with its id, its place in its cell, its height and its answer
  constexpr std::uint64_t bytes_of_point =
      sizeof(PlaceOfReceiver) + sizeof(std::string) + sizeof(std::size_t) + sizeof(std::optional<double>) + 3 * sizeof(float);
  MemoryNeeds needs{named.places.size() * bytes_of_point, 0, false};
  for (const auto& [cell, chosen] : cells) {
    needs.receivers_of_cell = std::max<std::uint64_t>(needs.receivers_of_cell, chosen.size());
    needs.whole_city = needs.whole_city || !package.grid().cells.contains(cell);
  }
  return needs;
}

/// A run over named points. Answers are computed cell by cell, and written in the order of the points.
class PointRun {
 public:
  PointRun(Package& package, const SvfOptions& options)
      : package_(package),
        options_(options),
        named_(read_places(options, package.manifest())),
        cells_(places_along_curve(package, named_.places)),
        values_(named_.places.size(), options.bounds),
        height_m_(named_.places.size()) {
    share_memory(package, options, needs_of(package, named_, cells_));
  }

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] CellReceivers receivers_of(std::size_t n) const {
    return receivers_at(package_, cells_[n].first, named_.places, cells_[n].second, options_.height_above,
                        static_cast<float>(options_.height_m));
  }
  void store(std::size_t, const CellReceivers& cell, const SvfValues& values) {
    for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
      const std::size_t n = cell.receivers[k].index;
      height_m_[n] = cell.receivers[k].p_cell.z + package_.manifest().height_origin_m;
      values_.svf[n] = values.svf[k];
      if (values.low.empty()) continue;
      values_.low[n] = values.low[k];
      values_.high[n] = values.high[k];
    }
  }
  void finish(SvfRun& run) const {
    run.inside_buildings = named_.places.size() - run.receivers;
    const auto row_of = [this](std::size_t n) {
      return PointRow{named_.ids[n],
                      named_.places[n].p_projected,
                      height_m_[n],
                      SvfValues::value(values_.svf, n),
                      SvfValues::value(values_.low, n),
                      SvfValues::value(values_.high, n)};
    };
    options_.format->write_points({named_.places.size(), row_of}, answer_columns(options_), options_.output);
    run.files = {options_.output};
  }

 private:
  const Package& package_;
  const SvfOptions& options_;
  NamedPlaces named_;
  PlacesByCell cells_;
  SvfValues values_;
  std::vector<std::optional<double>> height_m_;  ///< where a receiver stands is known once its cell is read
};

}  // namespace

SvfRun run_points(Package& package, const SvfOptions& options) {
  PointRun points(package, options);
  return evaluate_and_finish(package, options, points);
}

}  // namespace farlod
