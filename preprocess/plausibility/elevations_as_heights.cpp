// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/elevations_as_heights.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"

namespace farlod::plausibility {
namespace {

/// No town without lower buildings than this has an outline at each of its heights, or calls them elevations.
constexpr double lowest_of_elevations_m = 20.0;
/// Pencil towers are as slender, but not all buildings of a town.
constexpr double lowest_slender_m = 40.0, slenderness = 6.0;
/// Houses, as they stand on their ground.
constexpr double lowest_house_m = 1.5, highest_house_m = 40.0, largest_house_m2 = 400.0;
/// Files write elevations to a centimetre.
constexpr double same_m = 0.02, metres_in_foot = 0.3048;
constexpr std::size_t enough_of_one_outline = 3, enough_slender = 5, enough_houses = 5;
/// Fewer buildings than that may be chimneys, but none is as high as this.
constexpr std::size_t fewest_slender = 2;
constexpr double highest_chimney_m = 420.0;

template <class Holds>
bool nearly_all(std::span<const SaidHeight> heights, const Holds& holds) {
  const auto count = static_cast<std::size_t>(std::count_if(heights.begin(), heights.end(), holds));
  return 20 * count >= 19 * heights.size();
}

bool lies_at_its_height(const SaidHeight& h) {
  if (!h.outline_m) return false;
  return std::abs(*h.outline_m - h.height_m) <= same_m || std::abs(metres_in_foot * *h.outline_m - h.height_m) <= same_m;
}

bool is_as_high_as_an_elevation(const SaidHeight& h) { return h.height_m >= lowest_of_elevations_m; }

bool is_called_elevation(std::string_view field) {
  constexpr std::array parts{"elev", "altit", "nhn", "navd", "masl", "amsl", "msnm"};
  const std::string name = lower_case(field);
  return std::any_of(parts.begin(), parts.end(), [&](const char* part) { return name.find(part) != name.npos; });
}

constexpr std::string_view would_make = "would make all buildings ";

bool is_too_slender(const SaidHeight& h) {
  return h.height_m > lowest_slender_m && h.height_m > slenderness * std::sqrt(h.plan_m2);
}

bool is_a_house_above_its_ground(const SaidHeight& h) {
  const double above_m = h.height_m - h.ground_m.value_or(std::numeric_limits<double>::infinity());
  return h.ground_m.value_or(0.0) >= lowest_of_elevations_m && lowest_house_m <= above_m && above_m <= highest_house_m;
}

bool is_above_all_chimneys(const SaidHeight& h) { return h.height_m > highest_chimney_m && is_too_slender(h); }

bool are_houses(std::span<const SaidHeight> heights) {
  const auto small =
      std::count_if(heights.begin(), heights.end(), [](const SaidHeight& h) { return h.plan_m2 < largest_house_m2; });
  return 2 * static_cast<std::size_t>(small) >= heights.size() && nearly_all(heights, is_a_house_above_its_ground);
}

}  // namespace

std::optional<std::string> sign_of_elevations(std::span<const SaidHeight> heights, std::string_view field) {
  const std::size_t count = heights.size();
  if (count < enough_slender && count >= fewest_slender && nearly_all(heights, is_above_all_chimneys))
    return std::string(would_make) + "higher than any chimney";
  if (count < enough_of_one_outline) return std::nullopt;
  const bool is_called_so = is_called_elevation(field), is_high = nearly_all(heights, is_as_high_as_an_elevation);
  if ((is_called_so || is_high) && nearly_all(heights, lies_at_its_height))
    return "is the elevation at which the outlines of the buildings lie";
  if (is_called_so && is_high) return "is called an elevation, and would make all buildings higher than 20 m";
  if (count >= enough_slender && nearly_all(heights, is_too_slender))
    return std::string(would_make) + "six times as high as they are wide";
  if (count >= enough_houses && are_houses(heights))
    return "is for nearly all buildings the elevation of a house on their ground";
  return std::nullopt;
}

void require_heights(const std::string& source, const std::string& field, std::span<const SaidHeight> heights) {
  if (const auto sign = sign_of_elevations(heights, field))
    throw InputError(
        source + ": " + field + " holds elevations, no heights: it " + *sign + ". Give --roof-field " + field +
        " in place of --height-field; the ground comes from --terrain DEM, or from a field that --base-field names." +
        (sign->starts_with(would_make) ? " If they are heights in another unit, such as centimetres, convert them to metres."
                                       : ""));
}

namespace {

/// Enough to know a file by.
constexpr std::size_t most_footprints = 10'000;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Value>
double median_of(std::span<const HeightOnGround> heights, const Value& value) {
  std::vector<double> values;
  for (const HeightOnGround& h : heights) values.push_back(value(h));
  return median_of(std::move(values));
}

bool have_a_default(std::span<const HeightOnGround> heights) {
  std::map<double, std::size_t> counts;
  for (const HeightOnGround& h : heights)
    if (2 * ++counts[h.height_m] >= heights.size()) return true;
  return false;
}

/// The footprints of a file, and how many heights there are among them.
struct FootprintsOfFile {
  std::vector<SaidHeight> heights;
  std::set<double> different_m;
  Point3d highest;

  void add(std::span<const Point3d> points, const SurveyedGround& ground) {
    if (heights.size() == most_footprints) return;
    Box2d box;
    SaidHeight said;
    for (const Point3d& p : points) {
      box.add(horizontal(p));
      said.height_m = std::max(said.height_m, p.z);
    }
    const Point2d middle = 0.5 * (box.low + box.high);
    said.plan_m2 = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    if (ground.extent_city.contains(middle)) said.ground_m = ground.height_at(middle);
    if (heights.empty() || said.height_m > highest.z) highest = {middle.x, middle.y, said.height_m};
    different_m.insert(said.height_m);
    heights.push_back(said);
  }
  [[nodiscard]] bool are_measured() const { return 2 * different_m.size() > heights.size(); }
  [[nodiscard]] std::vector<HeightOnGround> on_ground() const {
    std::vector<HeightOnGround> known;
    for (const SaidHeight& h : heights)
      if (h.ground_m) known.push_back({h.height_m, *h.ground_m});
    return known;
  }
};

void require_no_elevations(const FootprintsOfFile& file, const std::string& source) {
  if (file.heights.size() < enough_houses || !file.are_measured() || !are_houses(file.heights)) return;
  throw InputError((source.empty() ? "" : source + ": ") +
                   "its heights are elevations: each is for nearly all buildings that of a house on the ground of the "
                   "terrain. Name their field with --roof-field in place of --height-field.");
}

std::string detail_of(const LikelyElevations& found, std::size_t count) {
  return fmt::format(
      "nearly all of its {} heights, typically {:.1f} m, are larger than the elevation of their ground, typically {:.1f} m, as "
      "those of no town with low buildings are: are they elevations of roofs, typically {:.1f} m above the ground? Name their "
      "field with --roof-field in place of --height-field",
      count, found.height_m, found.ground_m, found.above_m);
}

}  // namespace

std::optional<LikelyElevations> likely_elevations(std::span<const HeightOnGround> heights) {
  constexpr std::size_t enough = 10;
  constexpr double lowest_ground_m = 15.0, least_above_m = 2.0, most_above_m = 60.0;
  if (heights.size() < enough) return std::nullopt;
  const auto above =
      std::count_if(heights.begin(), heights.end(), [](const HeightOnGround& h) { return h.height_m > h.ground_m; });
  if (20 * static_cast<std::size_t>(above) < 19 * heights.size() || have_a_default(heights)) return std::nullopt;
  const LikelyElevations found{median_of(heights, [](const HeightOnGround& h) { return h.height_m; }),
                               median_of(heights, [](const HeightOnGround& h) { return h.ground_m; }),
                               median_of(heights, [](const HeightOnGround& h) { return h.height_m - h.ground_m; })};
  const bool are_likely = found.ground_m > lowest_ground_m && least_above_m <= found.above_m && found.above_m <= most_above_m;
  return are_likely ? std::optional(found) : std::nullopt;
}

void report_heights_above_ground(const LocatedCity& located, const SurveyedGround& ground, Report& report) {
  std::vector<FootprintsOfFile> files(std::max<std::size_t>(located.sources.size(), 1));
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (b.height_reference == HeightReference::on_ground && b.foot == Foot::on_ground)
      files[b.source].add(city.points_of(b), ground);
  });
  const Point2d origin_m = located.georeference.origin_m;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const std::string source = n < located.sources.size() ? located.sources[n] : "";
    require_no_elevations(files[n], source);
    const std::vector<HeightOnGround> heights = files[n].on_ground();
    if (const auto found = likely_elevations(heights))
      report.add({ProblemCode::implausible_size, source, "the whole file", detail_of(*found, heights.size()),
                  files[n].highest + Point3d{origin_m.x, origin_m.y, 0.0}});
  }
}

}  // namespace farlod::plausibility
