// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/named_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/lower_case.hpp"
#include "results/point_file.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

/// Rows that have a place.
std::vector<std::size_t> placed_rows(const NamedPoints& named) {
  std::vector<std::size_t> placed;
  for (std::size_t n = 0; n < named.ids.size(); ++n)
    if (named.has_place(n)) placed.push_back(n);
  return placed;
}

std::vector<Point2d> places_of_rows(const NamedPoints& named, std::span<const std::size_t> rows) {
  std::vector<Point2d> places;
  for (const std::size_t n : rows) places.push_back({named.x_m[n], named.y_m[n]});
  return places;
}

/// The places of all rows, NaN where one has none.
std::vector<Point2d> places_of(const NamedPoints& named) {
  std::vector<Point2d> places;
  for (std::size_t n = 0; n < named.ids.size(); ++n) places.push_back({named.x_m[n], named.y_m[n]});
  return places;
}

/// Points that cannot be projected lose their place, and are counted.
void move_to_package_crs(NamedPoints& named, const std::string& crs, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  const std::vector<std::size_t> placed = placed_rows(named);
  const std::vector<Point2d> given = places_of_rows(named, placed);
  const std::vector<Point2d> moved = gdal_files().reprojected_each(given, crs, package.crs_wkt);
  const auto is_lost = [](Point2d p) { return std::isnan(p.x); };
  const auto lost = static_cast<std::size_t>(std::ranges::count_if(moved, is_lost));
  for (std::size_t k = 0; k < placed.size(); ++k)
    std::tie(named.x_m[placed[k]], named.y_m[placed[k]]) = std::pair(moved[k].x, moved[k].y);
  if (lost == 0) return;
  const auto first = static_cast<std::size_t>(std::ranges::find_if(moved, is_lost) - moved.begin());
  named.skipped_features += lost;
  named.notes.push_back(
      fmt::format("{} of {} points cannot be projected and {} no answer; the first is point {} at {:.10g}, {:.10g}: "
                  "x is the longitude or easting, y the latitude or northing.",
                  lost, named.ids.size(), lost == 1 ? "has" : "have", named.ids[placed[first]], given[first].x, given[first].y));
#else
  throw PointsError("--points-crs " + crs +
                    " needs GDAL, which this farlod-svf was built without: give the points in the CRS of the "
                    "package (" +
                    package.crs_name + "), of which there are " + std::to_string(named.ids.size()) + ".");
#endif
}

/// Throws PointsError where none of these places of a file has one in the package's CRS.
void require_any_projected([[maybe_unused]] std::span<const Point2d> given, const NamedPoints& projected,
                           [[maybe_unused]] const std::string& crs, [[maybe_unused]] const SvfOptions& options,
                           [[maybe_unused]] const PackageDescription& package) {
  if (given.empty() || !placed_rows(projected).empty()) return;
#ifdef FARLOD_WITH_GDAL
  (void)gdal_files().reprojected_of_file(given, crs, package.crs_wkt,
                                         {options.points_file, advice_on_points_crs(!options.points_crs.empty())});
#endif
}

/// The CRS that the user names wins: many a GeoJSON is in another one than it must be.
std::string crs_of(const RequestedPoints& read, const SvfOptions& options, std::vector<std::string>& notes) {
  const std::string file = options.points_file.string();
  std::string own = read.crs_wkt.value_or("");
  if (!options.points_crs.empty()) {
    if (!own.empty())
      notes.push_back("The points of " + file + " were taken to be in " + options.points_crs +
                      " (--points-crs), whatever it says itself.");
    return options.points_crs;
  }
  if (read.crs_wkt && own.empty())
    notes.push_back(file + " says no CRS: its points were taken to be in that of the package (--points-crs names another).");
  return own;
}

RequestedPoints read_lines(const SvfOptions& options, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  return gdal_files().read_lines(options.points_file, options.points_layer,
                                 {options.surfaces.spacing_m, options.points_crs, package.crs_wkt});
#else
  throw PointsError(options.points_file.string() + " needs GDAL, which this farlod-svf was built without: give points of " +
                    package.crs_name + " as CSV (--points).");
#endif
}

bool has_column(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::any_of(names, [&](const std::string& n) { return lower_case(n) == lower_case(name); });
}

std::optional<double> known(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }
std::optional<double> known(const std::vector<float>& values, std::size_t n) {
  return values.empty() ? std::nullopt : known(static_cast<double>(values[n]));
}

std::optional<double> known_degrees(const std::vector<Angle>& angles, std::size_t n) {
  return angles.empty() ? std::nullopt : known(angles[n].degrees());
}

/// Nobody asks a city for places that are farther away: something is wrong with their coordinates.
constexpr double farthest_place_m = 100e3;

/// What lies nowhere on Earth is refused where it is evaluated.
bool is_on_some_map(Point2d p) {
  constexpr double beyond_all_maps_m = 1e9;
  return std::abs(p.x) < beyond_all_maps_m && std::abs(p.y) < beyond_all_maps_m;
}

/// How many lie near the city.
std::size_t near_count(const NamedPoints& named, const PackageDescription& package) {
  std::size_t count = 0;
  for (const Point2d p : places_of_rows(named, placed_rows(named))) count += is_near(p, package) ? 1 : 0;
  return count;
}

/// The points, with their coordinates taken for longitude and latitude, if that brings more than half of them near the city: in
/// some rows they may be exchanged.
std::optional<NamedPoints> near_as_degrees(NamedPoints named, const PackageDescription& package) {
  const std::vector<Point2d> given = places_of_rows(named, placed_rows(named));
  const auto are_degrees = [](Point2d p) { return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 90.0; };
  if (2 * static_cast<std::size_t>(std::ranges::count_if(given, are_degrees)) <= given.size()) return std::nullopt;
  move_to_package_crs(named, "OGC:CRS84", package);
  return 2 * near_count(named, package) > given.size() ? std::optional(std::move(named)) : std::nullopt;
}

/// The first that has a place.
Point2d first_of(const NamedPoints& named) {
  const std::vector<std::size_t> placed = placed_rows(named);
  return placed.empty() ? Point2d{} : Point2d{named.x_m[placed.front()], named.y_m[placed.front()]};
}

bool is_near_as_degrees(Point2d p, const PackageDescription& package) {
  RequestedPoints one;
  one.points.emplace_back();
  one.points.back().x = p.x;
  one.points.back().y = p.y;
  return near_as_degrees(NamedPoints(std::move(one)), package).has_value();
}

/// Whether a place, in a CRS or that of the package, lies near the city.
bool lies_near(Point2d p, const std::string& crs, const PackageDescription& package) {
  RequestedPoints one;
  one.points.emplace_back();
  std::tie(one.points.back().x, one.points.back().y) = std::pair(p.x, p.y);
  NamedPoints named(std::move(one));
  try {
    if (!crs.empty()) move_to_package_crs(named, crs, package);
  } catch (const InputError&) {
    return false;  // it has no place there
  }
  return near_count(named, package) > 0;
}

/// What a place that is far from the city, in a CRS or that of the package, looks like.
std::string looks_of(Point2d p, const std::string& crs, const PackageDescription& package) {
  const Point2d swapped{p.y, p.x};
  const std::string wgs84 = "OGC:CRS84";
  if (lies_near(swapped, crs, package)) return "with x and y exchanged it would lie at the city";
  if (crs != wgs84 && lies_near(p, wgs84, package)) return "it would lie at the city as longitude and latitude";
  if (crs != wgs84 && lies_near(swapped, wgs84, package)) return "it would lie at the city as latitude and longitude";
  if (!crs.empty() && is_near(p, package)) return "it would lie at the city in its CRS, " + package.crs_name;
  return "check its coordinates, and whether they are in another CRS";
}

/// Tells of the points that lie far from the city while others lie there. `given` are all points in the CRS that they have.
void tell_far_points(std::span<const Point2d> given, const std::string& crs, const PackageDescription& package,
                     NamedPoints& named) {
  std::size_t count = 0, first = 0;
  for (std::size_t n = 0; n < given.size(); ++n)
    if (named.has_place(n) && !is_near({named.x_m[n], named.y_m[n]}, package) && count++ == 0) first = n;
  if (count == 0 || near_count(named, package) == 0) return;
  const Point2d city = 0.5 * (package.outline_projected.low + package.outline_projected.high);
  named.notes.push_back(
      fmt::format("{} of {} points {} more than 100 km from the city and {} no answer: {}point {} in row {}, at {:.10g}, "
                  "{:.10g}, {:.0f} km away; {}.",
                  count, given.size(), count == 1 ? "lies" : "lie", count == 1 ? "has" : "have",
                  count == 1 ? "" : "the first is ", named.ids[first], first + 1, given[first].x, given[first].y,
                  norm(Point2d{named.x_m[first], named.y_m[first]} - city) / 1000.0, looks_of(given[first], crs, package)));
}

/// What is said of the CRS of points, and the first of them as it was given.
struct GivenPlaces {
  bool says_crs, may_say_crs;
  Point2d first;
};

/// Takes degrees for what they are where no CRS was said. Throws PointsError where all places lie far from the city.
NamedPoints near_city(NamedPoints named, const GivenPlaces& given, const PackageDescription& package) {
  if (near_count(named, package) > 0 || !is_on_some_map(first_of(named))) return named;
  const std::string first = fmt::format("{:.10g}, {:.10g}", given.first.x, given.first.y);
  if (auto degrees = given.says_crs ? std::nullopt : near_as_degrees(named, package)) {
    degrees->notes.push_back(fmt::format("{} was taken for longitude and latitude (WGS 84).", first));
    return std::move(*degrees);
  }
  const bool is_swapped = is_near_as_degrees({given.first.y, given.first.x}, package);
  const Point2d city = 0.5 * (package.outline_projected.low + package.outline_projected.high);
  throw PointsError(fmt::format("{} lies more than 100 km from the city, which is at {:.0f}, {:.0f} in {}: {}", first, city.x,
                                city.y, package.crs_name,
                                is_swapped          ? "give the longitude before the latitude."
                                : given.may_say_crs ? "check the coordinates, and their CRS (--points-crs)."
                                                    : "check the coordinates: they are of that CRS, or longitude and latitude."));
}

/// Gives an attribute a name that neither another one nor a column of the output has.
void rename_attribute(std::size_t k, const std::vector<std::string>& own, NamedPoints& named) {
  const std::string name = named.attributes.names()[k];
  std::string free = name + "_input";
  while (has_column(own, free) || has_column(named.attributes.names(), free)) free += "_input";
  named.attributes.rename(k, free);
  named.notes.push_back("The field \"" + name + "\" of the points comes back as \"" + free + "\": another column has its name.");
}

}  // namespace

NamedPoints::NamedPoints(RequestedPoints requested)
    : attributes(std::move(requested.attributes)),
      notes(std::move(requested.notes)),
      skipped_features(requested.skipped_features),
      doubtful_z(std::move(requested.doubtful_z)) {
  const auto is_above_ground = [](const RequestedPoint& p) { return p.above_ground_m.has_value(); };
  const bool any_above_ground = std::ranges::any_of(requested.points, is_above_ground);
  for (RequestedPoint& p : requested.points) {
    ids.push_back(std::move(p.id));
    x_m.push_back(p.x);
    y_m.push_back(p.y);
    z_m.push_back(p.z.value_or(std::nan("")));
    if (any_above_ground) above_ground_m.push_back(p.above_ground_m.value_or(std::nan("")));
    if (!requested.has_normals) continue;
    const RequestedNormal normal = p.normal.value_or(RequestedNormal{std::nan(""), std::nan("")});
    azimuth.push_back(Angle::degrees(normal.azimuth_deg));
    tilt.push_back(Angle::degrees(normal.tilt_deg));
  }
}

void NamedPoints::keep(const Region& region) {
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < ids.size(); ++n)
    if (region.contains({x_m[n], y_m[n]})) kept.push_back(n);
  if (kept.size() == ids.size()) return;
  const std::size_t outside = ids.size() - kept.size();
  const auto choose = [&kept](auto& values) {
    if (values.empty()) return;
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (kept[k] != k) values[k] = std::move(values[kept[k]]);
    values.resize(kept.size());
  };
  choose(ids);
  choose(x_m);
  choose(y_m);
  choose(z_m);
  choose(above_ground_m);
  choose(azimuth);
  choose(tilt);
  attributes = attributes.rows(kept);
  notes.push_back(std::to_string(outside) + (outside == 1 ? " point lies outside of the mask or box, and was left out."
                                                          : " points lie outside of the mask or box, and were left out."));
}

void NamedPoints::rename_attributes_that_clash(const AnswerColumns& columns) {
  const std::vector<std::string> own = own_columns_of_points(has_normals(), columns);
  for (std::size_t k = 0; k < attributes.names().size(); ++k) {
    const std::string name = attributes.names()[k];
    const bool is_repeated =
        has_column({attributes.names().begin(), attributes.names().begin() + static_cast<std::ptrdiff_t>(k)}, name);
    if (is_repeated || has_column(own, name)) rename_attribute(k, own, *this);
  }
}

void NamedPoints::add_reasons(const Reasons& reasons, const AnswerColumns& columns) {
  if (reasons.empty()) return;
  const std::string reason = "reason";
  const std::vector<std::string> own = own_columns_of_points(has_normals(), columns);
  for (std::size_t k = 0; k < attributes.names().size(); ++k)
    if (has_column({reason}, attributes.names()[k])) rename_attribute(k, own, *this);
  attributes.add_column(reason, ids.size(), [&](std::size_t n) {
    const auto found = reasons.find(n);
    return found == reasons.end() ? std::string() : found->second.words;
  });
}

bool is_near(Point2d p, const PackageDescription& package) {
  const auto& [low, high] = package.outline_projected;
  return std::hypot(std::max({low.x - p.x, p.x - high.x, 0.0}), std::max({low.y - p.y, p.y - high.y, 0.0})) <= farthest_place_m;
}

NamedPoints requested_points(const SvfOptions& options, const PackageDescription& package) {
  if (options.source == ReceiverSource::at) {
    RequestedPoints one;
    one.points = {options.at};
    return near_city(NamedPoints(std::move(one)), {false, false, {options.at.x, options.at.y}}, package);
  }
  if (options.source == ReceiverSource::lines) {
    NamedPoints lines(read_lines(options, package));
    const Point2d first = first_of(lines);
    return near_city(std::move(lines), {true, true, first}, package);
  }
  RequestedPoints read = read_point_file(options.points_file, options.points_layer);
  const std::string crs = crs_of(read, options, read.notes);
  NamedPoints named(std::move(read));
  const std::vector<Point2d> given = places_of(named);
  const Point2d first = first_of(named);
  if (!crs.empty()) {
    const std::vector<Point2d> placed = places_of_rows(named, placed_rows(named));
    move_to_package_crs(named, crs, package);
    require_any_projected(placed, named, crs, options, package);
  }
  named = near_city(std::move(named), {!crs.empty(), true, first}, package);
  const Point2d first_m = first_of(named);
  const bool were_degrees = crs.empty() && (first_m.x != first.x || first_m.y != first.y);
  tell_far_points(given, were_degrees ? "OGC:CRS84" : crs, package, named);
  return named;
}

PointRows rows_of(const NamedPoints& named, const PointAnswers& answers) {
  const auto row = [&](std::size_t n) {
    const std::size_t columns = answers.further.size() / named.ids.size();
    return PointRow{named.ids[n],
                    {named.x_m[n], named.y_m[n]},
                    known(answers.height_m[n]),
                    known(answers.svf, n),
                    known(answers.low, n),
                    known(answers.high, n),
                    known_degrees(named.azimuth, n),
                    known_degrees(named.tilt, n),
                    std::span(answers.further).subspan(n * columns, columns),
                    known(answers.above_ground_m[n])};
  };
  return {named.ids.size(), row, &named.attributes, named.has_normals()};
}

}  // namespace farlod
