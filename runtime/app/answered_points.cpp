// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/answered_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "app/written_run.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "farlod/plan_view.hpp"

namespace farlod {
namespace {

bool is_in_reach(const NamedPoints& named, std::size_t n, const PackageDescription& city) {
  return grown(city.outline_projected, answered_beyond_grid_m).contains({named.x_m[n], named.y_m[n]});
}

/// The rows of points that are evaluated.
std::vector<std::size_t> rows_in_reach(const NamedPoints& named, const PackageDescription& city) {
  std::vector<std::size_t> rows;
  for (std::size_t n = 0; n < named.ids.size(); ++n)
    if (is_in_reach(named, n, city)) rows.push_back(n);
  return rows;
}

/// The rows of points that have a place, and no answer there.
std::vector<std::size_t> rows_beyond(const NamedPoints& named, const PackageDescription& city) {
  std::vector<std::size_t> rows;
  for (std::size_t n = 0; n < named.ids.size(); ++n)
    if (named.has_place(n) && !is_in_reach(named, n, city)) rows.push_back(n);
  return rows;
}

/// Some elements of an array that has one for each point, or none.
template <class Value>
std::vector<Value> chosen_of(const std::vector<Value>& values, std::span<const std::size_t> rows) {
  std::vector<Value> chosen;
  if (values.empty()) return chosen;
  for (const std::size_t n : rows) chosen.push_back(values[n]);
  return chosen;
}

/// The points of some rows, as the library takes them.
struct ChosenPoints {
  ChosenPoints(const NamedPoints& named, std::span<const std::size_t> rows)
      : x_m(chosen_of(named.x_m, rows)),
        y_m(chosen_of(named.y_m, rows)),
        z_m(chosen_of(named.z_m, rows)),
        above_ground_m(chosen_of(named.above_ground_m, rows)),
        azimuth(chosen_of(named.azimuth, rows)),
        tilt(chosen_of(named.tilt, rows)) {}
  [[nodiscard]] Points points() const { return {x_m, y_m, z_m, azimuth, tilt, above_ground_m}; }

  std::vector<double> x_m, y_m, z_m, above_ground_m;
  std::vector<Angle> azimuth, tilt;
};

/// Values of some rows as values of all: others are NaN.
template <class Value>
void spread_over(std::size_t count, std::span<const std::size_t> rows, std::vector<Value>& values) {
  if (rows.empty() || values.empty()) return;
  const std::size_t columns = values.size() / rows.size();
  std::vector<Value> spread(count * columns, std::numeric_limits<Value>::quiet_NaN());
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t c = 0; c < columns; ++c) spread[rows[k] * columns + c] = values[k * columns + c];
  values = std::move(spread);
}

PointsError nowhere_on_earth(const NamedPoints& named, std::size_t n) {
  return PointsError("point " + named.ids[n] + " lies nowhere on Earth: check its coordinates, and its CRS (--points-crs)");
}

/// As Points has it.
bool lies_on_earth(const NamedPoints& named, std::size_t n) {
  constexpr double farthest_m = 1e8;
  return std::abs(named.x_m[n]) <= farthest_m && std::abs(named.y_m[n]) <= farthest_m;
}

PointAnswers answers_of_points(const Package& package, const Points& points, std::span<const std::size_t> rows,
                               const NamedPoints& named, const SvfOptions& options, const RunSettings& run) {
  try {
    return evaluate_points(package, points, options.placing, options.evaluation, run);
  } catch (const InvalidPoint& error) {
    throw nowhere_on_earth(named, rows[error.index()]);
  }
}

/// As the user gave it; where that was in another CRS, in that of the package, too.
std::string asked_place(const NamedPoints& named, std::size_t n, const SvfOptions& options) {
  const std::string projected = fmt::format("{:.10g}, {:.10g}", named.x_m[n], named.y_m[n]);
  if (options.source != ReceiverSource::at) return fmt::format("point {} at {}", named.ids[n], projected);
  const std::string given = fmt::format("{:.10g}, {:.10g}", options.at.x, options.at.y);
  return given == projected ? given : fmt::format("{} (longitude and latitude of {})", given, projected);
}

std::string extent_of(const Box2d& box, const PackageDescription& city) {
  return fmt::format("from {:.0f}, {:.0f} to {:.0f}, {:.0f} in {}", box.low.x, box.low.y, box.high.x, box.high.y, city.crs_name);
}

/// Heights at one place.
PlanHeights heights_at(const Package& package, Point2d p, std::size_t threads) {
  constexpr double pixel_m = 0.01;
  RunSettings run;
  run.threads = threads;
  return plan_heights(package, {p - Point2d{0.5 * pixel_m, -0.5 * pixel_m}, pixel_m, 1, 1}, run);
}

WhyUnanswered reason_at(const Package& package, const NamedPoints& named, std::size_t n, std::size_t threads) {
  using enum WhyUnanswered::Place;
  constexpr double least_building_m = 0.1;
  const PlanHeights heights = heights_at(package, {named.x_m[n], named.y_m[n]}, threads);
  const double ground_m = heights.ground_m.front(), highest_m = heights.highest_m.front(), z_m = named.z_m[n];
  const bool is_in_building = highest_m - ground_m > least_building_m;
  if (z_m < ground_m)
    return {"below the ground", fmt::format("its height of {:.2f} m is below the ground, which is at {:.2f} m", z_m, ground_m),
            is_in_building ? building : open_ground};
  if (is_in_building)
    return {"inside a building", fmt::format("inside a building, whose top is {:.1f} m above the ground", highest_m - ground_m),
            building};
  if (std::isnan(highest_m)) return {"no ground", "there is no ground"};
  const std::string either = "inside a building or below the ground";
  return {either, either};
}

}  // namespace

void require_any_in_reach(const NamedPoints& named, const SvfOptions& options, const PackageDescription& city) {
  const std::vector<std::size_t> beyond = rows_beyond(named, city);
  if (beyond.empty() || !rows_in_reach(named, city).empty()) return;
  if (!lies_on_earth(named, beyond.front())) throw nowhere_on_earth(named, beyond.front());
  throw NoAnswer(fmt::format(
      "No receiver has an answer, and nothing was written: {} lies more than {:g} m beyond the grid of the city{}. The grid lies "
      "{}: check --{}.",
      asked_place(named, beyond.front(), options), answered_beyond_grid_m,
      beyond.size() > 1 ? fmt::format(", as all {} points do", beyond.size()) : "", extent_of(city.outline_projected, city),
      option_of_place(options)));
}

void require_answers_of_points(const NamedPoints& named, const Reasons& reasons, const PointAnswers& answers,
                               const SvfOptions& options, const PackageDescription& city) {
  const auto in_reach = [&](const auto& reason) { return is_in_reach(named, reason.first, city); };
  const auto first = std::ranges::find_if(reasons, in_reach);
  if (answers.summary.receivers > 0 || first == reasons.end()) return;
  const auto count = static_cast<std::size_t>(std::ranges::count_if(reasons, in_reach));
  const auto& [n, why] = *first;
  const std::string place = asked_place(named, n, options);
  const std::string what =
      count == 1 ? place + " has none" : fmt::format("none of {} points has one; the first, {}", count, place);
  const bool is_outside = !city.city_projected.contains({named.x_m[n], named.y_m[n]});
  const std::string advice = is_outside ? fmt::format("It lies outside of the city, which lies {}: check --{}",
                                                      extent_of(city.city_projected, city), option_of_place(options))
                                        : "Choose other places, or --on-surface";
  throw NoAnswer(fmt::format("No receiver has an answer, and nothing was written: {} ({}). {}.", what, why.detail, advice));
}

std::optional<std::string> note_outside_of_grid(const NamedPoints& named, const PointAnswers& answers, const SvfOptions& options,
                                                const PackageDescription& city) {
  if (options.source != ReceiverSource::at || answers.summary.outside_of_grid == 0) return std::nullopt;
  return fmt::format(
      "{} lies outside of the grid of cells, which lies {}: horizons or rays of the whole city answered it, since only cells "
      "have far maps.",
      asked_place(named, 0, options), extent_of(city.outline_projected, city));
}

std::optional<std::string> note_of_points_beyond(const NamedPoints& named, const PackageDescription& city) {
  std::vector<std::size_t> beyond = rows_beyond(named, city);
  std::erase_if(beyond, [&](std::size_t n) { return !is_near({named.x_m[n], named.y_m[n]}, city); });
  if (beyond.empty()) return std::nullopt;
  const std::size_t first = beyond.front();
  return fmt::format(
      "{} of {} points {} more than {:g} m beyond the grid of the city and {} no answer; "
      "the first is point {} at {:.10g}, {:.10g}.",
      beyond.size(), named.ids.size(), beyond.size() == 1 ? "lies" : "lie", answered_beyond_grid_m,
      beyond.size() == 1 ? "has" : "have", named.ids[first], named.x_m[first], named.y_m[first]);
}

std::size_t count_below_open_ground(const Reasons& reasons) {
  return static_cast<std::size_t>(
      std::ranges::count(reasons, WhyUnanswered::Place::open_ground, [](const auto& reason) { return reason.second.place; }));
}

std::optional<std::string> note_of_heights(const NamedPoints& named, const Reasons& reasons, const PackageDescription& city) {
  if (named.doubtful_z.empty()) return std::nullopt;
  std::size_t in_the_open = 0;
  for (const std::size_t n : rows_in_reach(named, city)) {
    const auto reason = reasons.find(n);
    const bool is_answered = reason == reasons.end();
    if (!std::isnan(named.z_m[n]) && (is_answered || reason->second.place == WhyUnanswered::Place::open_ground)) ++in_the_open;
  }
  const std::size_t below = count_below_open_ground(reasons);
  return fmt::format(
      "\"{}\" was taken for an elevation above sea level{}: for heights above ground name it height_above_ground_m.",
      named.doubtful_z,
      below == 0 ? ""
                 : fmt::format(", where {} of {} points outside of buildings {} below the ground", below, in_the_open,
                               below == 1 ? "lies" : "lie"));
}

Reasons reasons_of_unanswered(const Package& package, const NamedPoints& named, const PointAnswers& answers,
                              std::size_t threads) {
  // Each looks up the heights at its place
  constexpr std::size_t most_looked_up = 1000;
  const PackageDescription& city = package.description();
  Reasons reasons;
  std::size_t looked_up = 0;
  for (std::size_t n = 0; n < named.ids.size(); ++n) {
    if (!std::isnan(answers.svf[n])) continue;
    if (!named.has_place(n))
      reasons[n] = {"no place", {}};
    else if (!is_in_reach(named, n, city))
      reasons[n] = {"beyond the grid", {}};
    else
      reasons[n] = ++looked_up > most_looked_up ? WhyUnanswered{"inside a building or without ground", {}}
                                                : reason_at(package, named, n, threads);
  }
  return reasons;
}

std::optional<std::string> note_of_unanswered(const NamedPoints& named, const Reasons& reasons, const PackageDescription& city) {
  constexpr std::size_t most_named = 5;
  std::size_t count = 0, in_buildings = 0;
  std::string first;
  for (const auto& [n, reason] : reasons) {
    if (!is_in_reach(named, n, city)) continue;
    in_buildings += reason.place == WhyUnanswered::Place::building ? 1 : 0;
    if (++count > most_named) continue;
    first += fmt::format("{}{} at {:.10g}, {:.10g} ({})", first.empty() ? "" : "; ", named.ids[n], named.x_m[n], named.y_m[n],
                         reason.detail);
  }
  if (count == 0) return std::nullopt;
  const std::size_t at_city = rows_in_reach(named, city).size();
  return fmt::format("{} of {} points{} {} no answer: {}{}.{}", count, at_city, at_city < named.ids.size() ? " at the city" : "",
                     count == 1 ? "has" : "have", first,
                     count > most_named ? fmt::format("; and {} more", count - most_named) : "",
                     in_buildings > 0 ? " --on-surface answers on the roofs." : "");
}

PointAnswers evaluate_named(const Package& package, const NamedPoints& named, const SvfOptions& options, const RunSettings& run) {
  const std::vector<std::size_t> rows = rows_in_reach(named, package.description());
  const std::size_t count = named.ids.size();
  if (rows.size() == count) return answers_of_points(package, named.points(), rows, named, options, run);
  const ChosenPoints chosen(named, rows);
  PointAnswers answers = answers_of_points(package, chosen.points(), rows, named, options, run);
  for (std::vector<float>* values : {&answers.svf, &answers.low, &answers.high, &answers.further})
    spread_over(count, rows, *values);
  for (std::vector<double>* values : {&answers.height_m, &answers.above_ground_m}) spread_over(count, rows, *values);
  if (!answers.summary.estimate) answers.summary.beyond_grid += rows_beyond(named, package.description()).size();
  return answers;
}

}  // namespace farlod
