// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/doubtful_heights.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/lower_case.hpp"

namespace farlod::plausibility {
namespace {

constexpr const char* advice = "name the field that has heights by --height-field, or convert it to metres";
constexpr std::size_t enough_values = 10;
/// An outline fills at least so much of its box, whichever way it is turned, unless it has yards or wings.
constexpr double least_filled = 0.35, most_filled = 1.05;
constexpr double most_storeys = 60.0, usual_storeys = 8.0, storeys_by_any_name = 3.0, whole = 1e-6;
/// Attics, and numbers that mean unknown, may be among storeys.
constexpr double least_share_of_whole = 0.98;
/// A Japanese town's heights, cut to whole metres, are so low for 2.3 %, mostly sheds; the storeys of its 300 largest buildings,
/// half of which have 5 and more, for 20 %.
constexpr std::size_t enough_storeys = 20;
constexpr double one_storey = 1.0, two_storeys = 2.0, large_m2 = 100.0, three_storeys = 3.0, least_share_too_low = 0.03;
constexpr double highest_usual_median_m = 300.0;
constexpr std::size_t enough_codes = 50;
constexpr double highest_code = 30.0, first_code = 1.0, least_share_of_first_code = 0.02;
constexpr double lowest_thin_m = 40.0, thin = 6.0;

bool is_like_its_area(const SaidHeight& h) {
  return least_filled * h.plan_m2 <= h.height_m && h.height_m <= most_filled * h.plan_m2;
}

bool is_thin(const SaidHeight& h) { return h.height_m > lowest_thin_m && h.height_m > thin * std::sqrt(h.plan_m2); }

bool is_whole(double number) { return std::abs(number - std::round(number)) < whole; }

bool may_count_storeys(const SaidHeight& h) { return h.height_m <= most_storeys && is_whole(h.height_m); }
/// Lower than a building of its size is in metres.
bool is_too_low(const SaidHeight& h) { return h.height_m <= one_storey || (h.height_m <= two_storeys && h.plan_m2 >= large_m2); }
bool is_two_or_three(const SaidHeight& h) { return h.height_m == two_storeys || h.height_m == three_storeys; }
bool may_be_code(const SaidHeight& h) { return h.height_m <= highest_code && is_whole(h.height_m); }
bool is_first_code(const SaidHeight& h) { return h.height_m <= first_code; }

template <class Holds>
double share_of(std::span<const SaidHeight> heights, const Holds& holds) {
  return static_cast<double>(std::count_if(heights.begin(), heights.end(), holds)) / static_cast<double>(heights.size());
}

double median_m(std::span<const SaidHeight> heights) {
  std::vector<double> values;
  for (const SaidHeight& h : heights) values.push_back(h.height_m);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool is_called_storeys(std::string_view field) {
  constexpr std::array parts{"floor",  "level", "storey", "stori",  "stock",   "etage",  "geschoss",   "planta",
                             "pisos",  "piani", "kaisu",  "niveau", "bouwlag", "vaning", "verdieping", "kondygnac",
                             "levels", "etasj", "kerros", "pavim",  "katlar",  "nbr_et", "nb_et",      "num_fl"};
  const std::string name = lower_case(field);
  return std::any_of(parts.begin(), parts.end(), [&](const char* part) { return name.find(part) != name.npos; });
}

/// `loft` and `shaft` end so, too.
bool is_called_feet(std::string_view field) {
  constexpr std::array endings{"heightft", "htft", "hgtft", "elevft", "roofft", "bldgft"};
  const std::string name = lower_case(field);
  return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return name.ends_with(ending); });
}

/// Whether whole numbers are too low for metres. Codes often leave out numbers beside 1.
bool are_low_as_storeys(std::span<const SaidHeight> heights) {
  return heights.size() >= enough_storeys && share_of(heights, is_too_low) >= least_share_too_low &&
         std::any_of(heights.begin(), heights.end(), is_two_or_three);
}

/// Heights that may be storeys.
std::optional<std::string> doubt_about_whole_numbers(std::span<const SaidHeight> heights, double typical_m,
                                                     std::string_view field) {
  if (share_of(heights, may_count_storeys) < least_share_of_whole) return std::nullopt;
  const bool is_called_so = is_called_storeys(field);
  if (typical_m > (is_called_so || are_low_as_storeys(heights) ? usual_storeys : storeys_by_any_name)) return std::nullopt;
  return fmt::format(
      "holds whole numbers, of which a typical one is {:g}, and they were read as metres: are they {}? Give --storeys-field {} "
      "in place of --height-field, and the height of a storey by --floor-height",
      typical_m, is_called_so ? "storeys" : "storeys, or codes of something else", field);
}

std::optional<std::string> doubt_about_codes(std::span<const SaidHeight> heights) {
  if (heights.size() < enough_codes || share_of(heights, may_be_code) < 1.0) return std::nullopt;
  const double first = share_of(heights, is_first_code);
  if (first < least_share_of_first_code) return std::nullopt;
  const auto [least, most] =
      std::minmax_element(heights.begin(), heights.end(), [](const auto& a, const auto& b) { return a.height_m < b.height_m; });
  return fmt::format(
      "holds whole numbers from {:g} to {:g}, of which {:.0f} % are 1, and they were read as metres: are they "
      "codes, such as of a use? If they are no heights, {}",
      least->height_m, most->height_m, 100.0 * first, advice);
}

bool are_too_high(std::span<const SaidHeight> heights, double typical_m) {
  constexpr double half = 0.5;
  return typical_m > highest_usual_median_m || share_of(heights, is_thin) >= half;
}

}  // namespace

std::optional<std::string> doubt_about_heights(std::span<const SaidHeight> heights, std::string_view field) {
  constexpr double most = 0.9;
  if (heights.size() < enough_values) return std::nullopt;
  const double typical_m = median_m(heights);
  if (share_of(heights, is_like_its_area) >= most)
    return fmt::format("is as large as the areas of the outlines, and was read as metres: {}", advice);
  if (auto doubt = doubt_about_whole_numbers(heights, typical_m, field)) return doubt;
  if (auto doubt = doubt_about_codes(heights)) return doubt;
  if (are_too_high(heights, typical_m))
    return fmt::format(
        "holds values of which a typical one is {:.0f}, and they were read as metres, which is higher than any town for such "
        "outlines: are they areas, numbers, or another unit? If they are no heights, {}",
        typical_m, advice);
  if (is_called_feet(field))
    return fmt::format("was read as metres: are they feet? A field whose name ends in _ft is read as feet: rename it to {}",
                       std::string(field.substr(0, field.size() - 2)) + "_ft");
  return std::nullopt;
}

std::optional<std::string> doubt_about_storeys(std::span<const SaidHeight> heights, std::string_view field,
                                               double floor_height_m) {
  constexpr double half = 0.5;
  if (heights.size() < enough_values) return std::nullopt;
  const double typical_m = median_m(heights), typical = typical_m / floor_height_m;
  // Attics count as half a storey
  const auto has_fraction = [&](const SaidHeight& h) { return !is_whole(2.0 * h.height_m / floor_height_m); };
  if (share_of(heights, has_fraction) >= half)
    return fmt::format(
        "holds numbers with fractions, of which a typical one is {:g}, and they were read as storeys of {:g} m: are they "
        "heights? "
        "Give --height-field {} in place of --storeys-field",
        typical, floor_height_m, field);
  if (are_too_high(heights, typical_m))
    return fmt::format(
        "holds values of which a typical one is {:g}, and they were read as storeys of {:g} m, which is higher than any town for "
        "such outlines: name the field that has storeys by --storeys-field",
        typical, floor_height_m);
  return std::nullopt;
}

}  // namespace farlod::plausibility
