// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/generated_city.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "farlod/error.hpp"
#include "generator/block_buildings.hpp"
#include "generator/building_plan.hpp"

namespace farlod {
namespace {

/// The number of evenly spread blocks from which the buildings of a city are estimated.
constexpr std::int64_t counted_blocks = 1500;

[[nodiscard]] double estimated_buildings(const CitySettings& settings) {
  const CityLayout layout(settings);
  const std::int64_t all = layout.block_count(), samples = std::min(all, counted_blocks);
  std::size_t found = 0;
  for (std::int64_t k = 0; k < samples; ++k) found += plans_of_block(settings, layout.block_at(k * all / samples)).size();
  return static_cast<double>(found) * static_cast<double>(all) / static_cast<double>(samples);
}

}  // namespace

std::vector<GeneratedBuilding> buildings_of_block(const CitySettings& settings, CityBlock block) {
  const PlanRotation rotation(settings.rotation_deg);
  std::vector<GeneratedBuilding> result;
  for (const PlanBuilding& building : raise_block(settings, block)) result.push_back(in_city(building, rotation));
  return result;
}

void visit_city(const CitySettings& settings, const CityVisitor& visitor) {
  check(settings);
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    for (const GeneratedBuilding& building : buildings_of_block(settings, layout.block_at(k))) visitor.building(building);
    visitor.block_done(k + 1);
  }
}

double size_for_buildings_m(CitySettings settings, std::int64_t buildings) {
  const auto count_at = [&settings](double size_m) {
    settings.size_m = size_m;
    return estimated_buildings(settings);
  };
  constexpr double step_m = 10.0;
  SettingRange range{};
  CitySettings::describe(settings, [&range](std::string_view name, auto, SettingRange r, auto&&...) {
    if (name == "size") range = r;
  });
  const auto wanted = static_cast<double>(buildings);
  if (buildings < 1 || wanted > count_at(range.high))
    throw InvalidArgument(
        fmt::format("--buildings is {}; a city can have from 1 to about {:.3g}", buildings, count_at(range.high)));
  // Halve the interval of sizes that brackets the wanted number
  double low_m = range.low, high_m = range.high;
  while (high_m - low_m > step_m) {
    const double middle_m = step_m * std::round(0.5 * (low_m + high_m) / step_m);
    if (middle_m <= low_m || middle_m >= high_m) break;
    (count_at(middle_m) < wanted ? low_m : high_m) = middle_m;
  }
  return std::abs(count_at(low_m) - wanted) < std::abs(count_at(high_m) - wanted) ? low_m : high_m;
}

}  // namespace farlod
