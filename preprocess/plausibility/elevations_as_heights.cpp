// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/elevations_as_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
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

/// The footprints of a file, and how many heights there are among them.
struct FootprintsOfFile {
  std::vector<SaidHeight> heights;
  std::set<double> different_m;

  void add(std::span<const Point3d> points, const KnownGroundHeightAt& ground_height) {
    if (heights.size() == most_footprints) return;
    Box2d box;
    SaidHeight said;
    for (const Point3d& p : points) {
      box.add(horizontal(p));
      said.height_m = std::max(said.height_m, p.z);
    }
    said.plan_m2 = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    said.ground_m = ground_height(0.5 * (box.low + box.high));
    different_m.insert(said.height_m);
    heights.push_back(said);
  }
  [[nodiscard]] bool are_measured() const { return 2 * different_m.size() > heights.size(); }
};

}  // namespace

void require_heights_above_ground(const LocatedCity& located, const KnownGroundHeightAt& ground_height) {
  std::vector<FootprintsOfFile> files(std::max<std::size_t>(located.sources.size(), 1));
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (b.height_reference == HeightReference::on_ground && b.foot == Foot::on_ground)
      files[b.source].add(city.points_of(b), ground_height);
  });
  for (std::size_t n = 0; n < files.size(); ++n)
    if (files[n].heights.size() >= enough_houses && files[n].are_measured() && are_houses(files[n].heights))
      throw InputError((n < located.sources.size() ? located.sources[n] + ": " : "") +
                       "its heights are elevations: each is for nearly all buildings that of a house on the ground of the "
                       "terrain. Name their field with --roof-field in place of --height-field.");
}

}  // namespace farlod::plausibility
