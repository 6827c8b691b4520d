// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "base/run_settings.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "package/manifest.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/point_receivers.hpp"
#include "run/facing.hpp"
#include "run/memory_limit.hpp"
#include "run/ordered_run.hpp"

namespace farlod {
namespace {

void require_as_long(const char* name, std::size_t size, std::size_t wanted) {
  if (size != wanted)
    throw InvalidArgument(std::string(name) + " has " + std::to_string(size) + " elements, and the points are " +
                          std::to_string(wanted) + ": give one for each point");
}

void require_same_sizes(const Points& points, const PointAnswerSpans& answers, bool bounds, std::size_t further_columns) {
  const std::size_t count = points.x_m.size();
  require_as_long("y_m", points.y_m.size(), count);
  if (!points.z_m.empty()) require_as_long("z_m", points.z_m.size(), count);
  if (!points.azimuth.empty()) require_as_long("azimuth", points.azimuth.size(), count);
  if (!points.tilt.empty()) require_as_long("tilt", points.tilt.size(), count);
  if (!points.above_ground_m.empty()) require_as_long("above_ground_m", points.above_ground_m.size(), count);
  if (points.azimuth.empty() != points.tilt.empty())
    throw InvalidArgument("a normal is an azimuth and a tilt, and one of the two is not given: give both, or neither");
  require_as_long("svf", answers.svf.size(), count);
  if (!answers.height_m.empty()) require_as_long("height_m", answers.height_m.size(), count);
  if (!answers.above_ground_m.empty()) require_as_long("above_ground_m", answers.above_ground_m.size(), count);
  if (answers.further.size() != further_columns * count)
    throw InvalidArgument("further has " + std::to_string(answers.further.size()) + " elements: give " +
                          std::to_string(further_columns) + " for each of " + std::to_string(count) +
                          " points, which is how many EvaluationSettings::further asks for");
  if (!bounds && !(answers.low.empty() && answers.high.empty()))
    throw InvalidArgument(
        "low and high are given, and no bounds are asked for: set EvaluationSettings::bounds, or leave them out");
  if (!bounds) return;
  require_as_long("low", answers.low.size(), count);
  require_as_long("high", answers.high.size(), count);
}

/// No map is as large, and no place on it as high or as low.
bool is_on_earth(const PlaceOfReceiver& place) {
  constexpr double highest_m = 1e5;
  const Point2d& p = place.p_projected;
  // Written so that NaN is not, either
  return std::abs(p.x) <= farthest_coordinate && std::abs(p.y) <= farthest_coordinate &&
         std::abs(place.height_m.value_or(0.0)) <= highest_m;
}

/// So many small cells would lie between the grid and a place far away that its cell has no number (exact_cell_edge_m).
bool has_a_cell(const PlaceOfReceiver& place, const package::Manifest& manifest) {
  const Point2d p_grid = manifest.grid_from_projected(place.p_projected);
  const double farthest_m = farthest_cell_index * manifest.grid.cell_edge_m;
  return std::abs(p_grid.x) < farthest_m && std::abs(p_grid.y) < farthest_m;
}

InvalidPoint point_lies(std::size_t n, const std::string& where) {
  return {n, "the point of index " + std::to_string(n) + " (counted from 0) lies " + where};
}

void require_usable(const PlaceOfReceiver& place, const package::Manifest& manifest, std::size_t n) {
  if (!is_on_earth(place)) throw point_lies(n, "nowhere on Earth: check its coordinates, and their CRS");
  if (!has_a_cell(place, manifest))
    throw point_lies(n, "too far from the city for the cells of its grid: leave it out, or check its CRS");
}

/// Where the n-th point looks. A tilt that is NaN says no more than that it looks straight up.
Point3f normal_of_point(const Points& points, std::size_t n, const package::Manifest& manifest) {
  if (points.tilt.empty() || std::isnan(points.tilt[n].radians())) return {0.0F, 0.0F, 1.0F};
  const Facing facing{points.azimuth[n], points.tilt[n]};
  constexpr Angle level_turn = Angle::degrees(360.0), half_turn = Angle::degrees(180.0);
  // Written so that an azimuth of NaN is not, either
  const bool is_direction =
      Angle{} <= facing.tilt && facing.tilt <= half_turn && -level_turn <= facing.azimuth && facing.azimuth <= level_turn;
  if (!is_direction)
    throw InvalidPoint(n, "the point of index " + std::to_string(n) +
                              " (counted from 0) has a normal that is none: give an azimuth from -360° to 360° and a tilt from "
                              "0° to 180°, or NaN as its tilt to let it look straight up");
  const Point3d normal = normal_of(facing, manifest);
  return {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
}

/// None where the point has a height above sea level, or none at all.
std::optional<double> above_ground_of_point(const Points& points, std::size_t n, const PlaceOfReceiver& place) {
  if (points.above_ground_m.empty() || place.height_m || std::isnan(points.above_ground_m[n])) return std::nullopt;
  constexpr double highest_m = 10'000.0;
  if (!(0.0 <= points.above_ground_m[n] && points.above_ground_m[n] <= highest_m))
    throw InvalidPoint(n, "the point of index " + std::to_string(n) +
                              " (counted from 0) has a height above ground that is not between 0 and 10,000 m: give one that is, "
                              "or NaN to place it like the others");
  return points.above_ground_m[n];
}

std::vector<PlaceOfReceiver> places_of(const Points& points, const package::Manifest& manifest) {
  std::vector<PlaceOfReceiver> places(points.x_m.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    places[n].p_projected = {points.x_m[n], points.y_m[n]};
    if (!points.z_m.empty() && !std::isnan(points.z_m[n])) places[n].height_m = points.z_m[n];
    require_usable(places[n], manifest, n);
    places[n].normal_grid = normal_of_point(points, n, manifest);
    places[n].above_ground_m = above_ground_of_point(points, n, places[n]);
  }
  return places;
}

/// The places that are evaluated, by their cells along the curve, and how many of those that are wanted lie too far away.
struct PlacesByCell {
  std::vector<std::pair<Cell, std::vector<std::size_t>>> cells;
  std::size_t beyond_grid = 0;
};

PlacesByCell places_along_curve(const PackageReader& package, std::span<const PlaceOfReceiver> places,
                                const ResolvedSettings& settings) {
  std::map<Cell, std::vector<std::size_t>> by_cell;
  std::vector<Cell> cells;
  PlacesByCell result;
  const package::Manifest& manifest = package.manifest();
  const Box2d answered = grown(manifest.projected_outline(manifest.grid.rectangle()), answered_beyond_grid_m);
  for (auto& [cell, chosen] : places_by_cell(package, places)) {
    std::erase_if(chosen, [&](std::size_t n) { return !settings.wants(places[n].p_projected); });
    result.beyond_grid += std::erase_if(chosen, [&](std::size_t n) { return !answered.contains(places[n].p_projected); });
    if (chosen.empty()) continue;
    cells.push_back(cell);
    by_cell[cell] = std::move(chosen);
  }
  for (const Cell cell : along_hilbert_curve(std::move(cells), package.grid().block_edge))
    result.cells.emplace_back(cell, std::move(by_cell[cell]));
  return result;
}

MemoryNeeds needs_of(const PackageReader& package, Engine engine, std::size_t point_count, const PlacesByCell& cells) {
  // A point, and its place in its cell; its answer is the caller's
  constexpr double bytes_of_point = sizeof(PlaceOfReceiver) + sizeof(std::size_t);
  MemoryNeeds needs{static_cast<double>(point_count) * bytes_of_point};
  for (const auto& [cell, chosen] : cells.cells) {
    needs.receivers_of_cell = std::max(needs.receivers_of_cell, static_cast<double>(chosen.size()));
    needs.whole_city = needs.whole_city || any_traces_whole_city(package, engine, {&cell, 1});
  }
  return needs;
}

void fill_with_no_data(const PointAnswerSpans& answers) {
  std::ranges::fill(answers.svf, SvfValues::no_data);
  std::ranges::fill(answers.low, SvfValues::no_data);
  std::ranges::fill(answers.high, SvfValues::no_data);
  std::ranges::fill(answers.further, SvfValues::no_data);
  std::ranges::fill(answers.height_m, std::numeric_limits<double>::quiet_NaN());
  std::ranges::fill(answers.above_ground_m, std::numeric_limits<double>::quiet_NaN());
}

/// Answers are in the order of the cell's receivers, whose indices are those of the points.
void store_answers(const CellReceivers& cell, const SvfValues& values, double height_origin_m, const PointAnswerSpans& answers) {
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
    const std::size_t n = cell.receivers[k].index;
    answers.svf[n] = values.svf[k];
    if (!answers.height_m.empty()) answers.height_m[n] = cell.receivers[k].p_cell.z + height_origin_m;
    std::ranges::copy(values.further_of(k), answers.further.begin() + static_cast<std::ptrdiff_t>(n * values.further_columns));
    if (values.low.empty()) continue;
    answers.low[n] = values.low[k];
    answers.high[n] = values.high[k];
  }
}

/// Points cell by cell. All must outlive it.
class PointCells final : public CellsOfRun {
 public:
  PointCells(const PackageReader& package, std::span<const PlaceOfReceiver> places, const PlacesByCell& cells,
             const Placing& placing, const std::stop_token& stop, const PointAnswerSpans& answers)
      : package_(package), places_(places), cells_(cells), placing_(placing), stop_(stop), answers_(answers) {}

  [[nodiscard]] std::size_t size() const override { return cells_.cells.size(); }
  [[nodiscard]] Cell place(std::size_t n) const override { return cells_.cells[n].first; }
  [[nodiscard]] double receivers_about(std::size_t n) const override {
    return static_cast<double>(cells_.cells[n].second.size());
  }
  [[nodiscard]] CellReceivers receivers(std::size_t n) override {
    return receivers_at(package_, cells_.cells[n].first, places_, cells_.cells[n].second, placing_.above,
                        package_height_m(placing_, package_.manifest()), stop_, answers_.above_ground_m);
  }
  void store(std::size_t, const CellReceivers& cell, const SvfValues& values) override {
    store_answers(cell, values, package_.manifest().height_origin_m, answers_);
  }

 private:
  const PackageReader& package_;
  std::span<const PlaceOfReceiver> places_;
  const PlacesByCell& cells_;
  const Placing& placing_;
  const std::stop_token& stop_;
  const PointAnswerSpans& answers_;
};

/// The summary of a run over all points.
EvaluationSummary with_counts(EvaluationSummary summary, std::size_t points, const PlacesByCell& cells) {
  std::size_t asked = 0;
  for (const auto& [cell, chosen] : cells.cells) asked += chosen.size();
  summary.outside_of_region = points - asked - cells.beyond_grid;
  summary.beyond_grid = cells.beyond_grid;
  summary.no_data = asked - summary.receivers;
  return summary;
}

}  // namespace

EvaluationSummary evaluate_points(const Package& package, const Points& points, const Placing& placing,
                                  const EvaluationSettings& evaluation, const PointAnswerSpans& answers, const RunSettings& run) {
  const ResolvedSettings settings = resolved(evaluation, run);
  const Placing placed = resolved(placing);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_same_sizes(points, answers, settings.bounds, columns_of(settings.sky.further).size());
  const std::vector<PlaceOfReceiver> places = places_of(points, reader.manifest());
  const PlacesByCell cells = places_along_curve(reader, places, settings);
  const double memory_bytes =
      require_memory(reader.manifest(), settings, needs_of(reader, settings.sky.engine, places.size(), cells));
  fill_with_no_data(answers);
  PointCells point_cells(reader, places, cells, placed, run.stop, answers);
  EvaluationSummary summary = evaluate_cells(in_use, settings, point_cells);
  if (summary.estimate) return with_memory(std::move(summary), memory_bytes);
  return settings.run.shard ? summary : with_counts(std::move(summary), places.size(), cells);
}

PointAnswers evaluate_points(const Package& package, const Points& points, const Placing& placing,
                             const EvaluationSettings& settings, const RunSettings& run) {
  const std::size_t count = points.x_m.size(), bounds = settings.bounds ? count : 0;
  const std::size_t further = count * columns_of(settings.further).size();
  const RunSettings with_answers =
      with_bytes_of_caller(run, (count + 2 * bounds + further) * sizeof(float) + 2 * count * sizeof(double));
  PointAnswers answers{std::vector<float>(count),  std::vector<float>(bounds),  std::vector<float>(bounds),
                       std::vector<double>(count), std::vector<float>(further), {},
                       std::vector<double>(count)};
  answers.summary = evaluate_points(
      package, points, placing, settings,
      {answers.svf, answers.low, answers.high, answers.height_m, answers.further, answers.above_ground_m}, with_answers);
  return answers;
}

}  // namespace farlod
