// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/error.hpp"
#include "georeference/georeference.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {
namespace {

/// Where most trees are, whatever the others are: medians, and the length within which nine of ten are.
struct Spread {
  Point2d middle;
  double length = 0.0;
};

Spread spread_of(const PagedArray<Tree>& trees) {
  constexpr std::size_t enough = 10'000;
  const std::size_t stride = std::max<std::size_t>(trees.size() / enough, 1);
  std::vector<double> x, y;
  for (std::size_t n = 0; n < trees.size(); n += stride) {
    x.push_back(trees[n].place.x);
    y.push_back(trees[n].place.y);
  }
  Spread spread;
  const auto measure = [&](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    const std::size_t margin = values.size() / 20;
    spread.length = std::max(spread.length, values[values.size() - 1 - margin] - values[margin]);
    return values[values.size() / 2];
  };
  spread.middle = {measure(x), measure(y)};
  return spread;
}

bool may_be_degrees(Point2d p) { return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 360.0; }

/// No inventory in metres has all of its trees within two of them.
bool look_like_degrees(const Spread& spread, std::size_t count) {
  return count > 1 && may_be_degrees(spread.middle) && spread.length < 2.0;
}

/// The CRS of the file, or what stands in for it.
InputCrs crs_of(const SourceTrees& trees, const std::string& fallback, const Crs& output, const Spread& spread) {
  const std::string& own = trees.crs.definition;
  const auto found = own.empty() ? std::nullopt : find_crs(own);
  const auto given = fallback.empty() ? std::nullopt : std::optional(crs_of_input(trees.source, "", fallback));
  if (own.empty()) return {given ? *given : NamedCrs{output}};
  if (!found)
    return {given ? *given : crs_of_input(trees.source, own, ""), ProblemCode::crs_unknown,
            "the CRS that it names is unknown; that of --crs is used"};
  // GeoJSON without a CRS is in degrees by its standard; many programs write it in metres all the same
  const bool cannot_be = !found->crs.is_projected() && !may_be_degrees(spread.middle);
  if (cannot_be && given && given->crs.is_projected())
    return {
        *given, ProblemCode::two_crs,
        "the file says " + found->crs.name() + ", but " + place_text(spread.middle) + " are no degrees; that of --crs is used"};
  return {*found};
}

void require_possible(const SourceTrees& trees, const Crs& crs, const Spread& spread) {
  const std::string place = " (" + place_text(spread.middle) + "): ";
  if (!crs.is_projected() && !may_be_degrees(spread.middle))
    throw InputError(trees.source + ": its CRS " + crs.name() + " counts in degrees, but its coordinates cannot be degrees" +
                     place + "name the CRS that they are in, in the file or with --crs EPSG:n");
  if (crs.is_projected() && look_like_degrees(spread, trees.trees.size()))
    throw InputError(trees.source + ": its CRS " + crs.name() + " is projected, but its coordinates look like degrees" + place +
                     "name the columns lon and lat, or the CRS that they are in, in the file or with --crs EPSG:n");
}

/// Resolves the axes at a place that stands for all trees, and reports what is wrong with them.
ResolvedSource resolved_axes(const SourceTrees& trees, const InputCrs& input, Point2d middle, Report& report) {
  SourceCity place;
  place.source = trees.source;
  place.crs = trees.crs;
  place.relief_points = {{middle.x, middle.y, 0.0}};
  return resolve(std::move(place), input, report);
}

FileAxes in_other_order(FileAxes axes) {
  axes.order = axes.order == AxisOrder::easting_first ? AxisOrder::northing_first : AxisOrder::easting_first;
  return axes;
}

/// Degrees in the wrong order mostly lie somewhere on Earth, too. What lies at the city in the other order, and far from it in
/// its own, is taken in the other one.
FileAxes axes_at_city(const ResolvedSource& resolved, Point2d middle, const Crs& output, Point2d origin_m, Report& report) {
  constexpr double far_m = 100e3;
  if (resolved.crs.is_projected()) return resolved.axes;
  const auto is_near = [&](const FileAxes& axes) {
    Point3d p = axes.p_map({middle.x, middle.y, 0.0});
    if (std::abs(p.y) > 90.0) return false;
    make_projection(resolved.crs, output, horizontal(p))({&p, 1});
    return is_on_a_map(p) && norm(horizontal(p) - origin_m) < far_m;
  };
  const FileAxes other = in_other_order(resolved.axes);
  if (is_near(resolved.axes) || !is_near(other)) return resolved.axes;
  const char* const first = other.order == AxisOrder::northing_first ? "latitude" : "longitude";
  report.add({ProblemCode::axes_swapped, resolved.source.source, "the whole file",
              "coordinates such as " + place_text(middle) + " are taken " + first +
                  " first: in the other order they lie far from the city",
              Point3d{middle.x, middle.y, 0.0}});
  return other;
}

/// Projects the trees some at a time, and keeps those that have a place. Returns the first place in the file that has none.
std::optional<Point2d> project(PagedArray<Tree>& trees, const FileAxes& axes, const Projection& projection, Point2d origin_m) {
  constexpr std::size_t at_a_time = 4096;
  std::optional<Point2d> lost;
  std::vector<Point3d> points;
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin < trees.size(); begin += at_a_time) {
    const std::size_t end = std::min(begin + at_a_time, trees.size());
    points.clear();
    for (std::size_t n = begin; n < end; ++n) points.push_back(axes.p_map({trees[n].place.x, trees[n].place.y, 0.0}));
    projection(points);
    for (std::size_t n = begin; n < end; ++n) {
      const Point3d& p = points[n - begin];
      if (!is_on_a_map(p)) {
        if (!lost) lost = trees[n].place;
        continue;
      }
      trees[kept] = trees[n];
      trees[kept++].place = horizontal(p) - origin_m;
    }
  }
  trees.resize(kept);
  return lost;
}

}  // namespace

void locate_trees(SourceTrees& trees, const std::string& fallback_crs, const Georeference& georeference, Report& report) {
  if (trees.trees.empty()) return;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Spread spread = spread_of(trees.trees);
  const InputCrs input = crs_of(trees, fallback_crs, *output, spread);
  require_possible(trees, input.named.crs, spread);
  const ResolvedSource resolved = resolved_axes(trees, input, spread.middle, report);
  const FileAxes axes = axes_at_city(resolved, spread.middle, *output, georeference.origin_m, report);
  const Point2d typical = horizontal(axes.p_map({spread.middle.x, spread.middle.y, 0.0}));
  const std::size_t all = trees.trees.size();
  const auto lost = project(trees.trees, axes, make_projection(resolved.crs, *output, typical), georeference.origin_m);
  if (lost)
    report.add({ProblemCode::tree_outside_of_grid, trees.source, "the whole file",
                std::to_string(all - trees.trees.size()) + " of " + std::to_string(all) + " trees, of which the first is at " +
                    place_text(*lost) + ", have no place in " + output->name() + ": check the CRS, if they should",
                Point3d{lost->x, lost->y, 0.0}});
  ProblemLocator locator(resolved.crs, axes, typical);
  for (Problem& problem : report.since(0)) {
    if (problem.source != trees.source || problem.lon_lat_deg) continue;
    locator.locate(problem);
    // Others of this kind have a place in the CRS of the package
    if (problem.code == ProblemCode::tree_outside_of_grid) problem.position.reset();
  }
}

}  // namespace farlod::georeference
