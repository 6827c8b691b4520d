// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/light_of_little_sky.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/analytic/packed_around.hpp"
#include "tests/scenes/light_by_rays.hpp"

// A year of hours among buildings, hour by hour and ray by ray: the judge of one distribution for all of them.

namespace farlod {
namespace {

using std::numbers::pi;

/// Boxes around a square of 60 m, of heights from 4 to 40 m.
void add_town(scenes::SceneBuilder& builder) {
  std::mt19937_64 random(1993);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 90; ++n) {
    const Point2d low{between(-110.0, 95.0), between(-110.0, 95.0)}, edges{between(6.0, 20.0), between(6.0, 20.0)};
    const double height_m = between(4.0, 40.0);
    const bool is_square = low.x > -30.0 - edges.x && low.x < 30.0 && low.y > -30.0 - edges.y && low.y < 30.0;
    if (!is_square) builder.add_box({low, low + edges}, -1.5, height_m);
  }
}

/// The sun at an hour of a day, at 48° north.
SunPosition sun_at(int day, double hour, double hours) {
  const double latitude = 48.0 * pi / 180.0;
  const double declination = -23.44 * pi / 180.0 * std::cos(2.0 * pi * (day + 10) / 365.0);
  const double turn = 2.0 * pi * (hour - 12.0) / 24.0;
  const double up = std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(turn);
  const double west = std::cos(declination) * std::sin(turn),
               south = std::sin(latitude) * std::cos(declination) * std::cos(turn) - std::cos(latitude) * std::sin(declination);
  return {Angle::radians(std::atan2(-west, -south)), Angle::radians(std::asin(up)), hours};
}

/// Days of mean declinations, half of the hours clear.
Light year_of_light(int positions_in_hour = 12) {
  Light light{{}, SkyModel::perez, 0.0, 0.0};
  light.by_month = true;
  for (int day = 0; day < 365; ++day)
    for (int hour = 4; hour < 20; ++hour) {
      LightInterval interval{{}, 1.0};
      for (int part = 0; part < positions_in_hour; ++part) {
        const SunPosition sun = sun_at(day, hour + (part + 0.5) / positions_in_hour, 1.0 / positions_in_hour);
        if (sun.elevation.radians() > 0.0) interval.sun.push_back(sun);
      }
      const double up = sin(sun_at(day, hour + 0.5, 1.0).elevation);
      if (interval.sun.empty() || up <= 0.0) continue;
      const bool is_clear = (day * 7 + hour / 3) % 2 == 0;
      interval.direct_normal_w_m2 = is_clear ? 950.0 * std::exp(-0.18 / std::max(up, 0.05)) : 60.0 * up;
      interval.diffuse_w_m2 = is_clear ? 30.0 + 90.0 * up : 20.0 + 330.0 * up;
      interval.month = static_cast<unsigned>(day / 31) + 1;
      light.intervals.push_back(std::move(interval));
    }
  return light;
}

std::vector<Point3d> normals_of_receivers() {
  return {{0, 0, 1},  {0, 0, 1},
          {0, 0, 1},  {0, 0, 1},
          {0, -1, 0}, {1, 0, 0},
          {-1, 0, 0}, normalized(Point3d{0.3, -0.5, 0.7}),
          {0, 0, 1},  {0, 0, 1},
          {0, 0, 1},  {0, 0, 1},
          {0, 1, 0},  normalized(Point3d{-0.6, 0.4, 0.6}),
          {0, 0, 1},  {0, 0, 1}};
}

/// What the sun, seen past an edge between two azimuths, may add or lack in a month; crowns have more edges.
constexpr double of_edges_kwh_m2 = 0.1, of_crowns_kwh_m2 = 0.3;

/// The year of each receiver, and its months, are those of rays but for `year_error` and `month_error` of them.
void expect_the_light_of_rays(const PackageReader& package, Engine engine, const Quantities& quantities,
                              const CellReceivers& receivers, const scenes::LightByRays& judge, const std::string& which) {
  const WholeCityOnDemand city(package, {});
  const std::size_t columns = columns_of(quantities).size();
  std::vector<float> svf(receivers.receivers.size()), values(svf.size() * columns);
  const SkySettings settings{.engine = engine, .rays = 20000, .further = quantities};
  SkyEvaluator(package, settings).evaluate(receivers, SkyAnswers(svf, {}, {}, values));
  for (const Receiver& r : receivers.receivers) {
    const scenes::LightByRays::Months months =
        judge.on(city.city().scene_from_cell(r.p_cell, {0, 0}), {r.normal.x, r.normal.y, r.normal.z}, city.city().occluder(),
                 package.has_crowns() ? &city.crowns(quantities.canopy) : nullptr);
    const float* const got = &values[r.index * columns];
    const double year = scenes::year_of(months);
    EXPECT_NEAR(got[0], year, 0.005 * year) << which << ", receiver " << r.index << ", svf " << svf[r.index];
    for (std::size_t m = 0; m < months.size(); ++m)
      EXPECT_NEAR(got[4 + m], months[m], 0.01 * months[m] + (package.has_crowns() ? of_crowns_kwh_m2 : of_edges_kwh_m2))
          << which << ", receiver " << r.index << ", month " << m + 1;
  }
}

TEST(IrradiationOfAYear, IsThatOfEachHourAndRay) {
  const PackedAround packed(Angle::degrees(20.0), add_town);
  const Light light = year_of_light();
  const scenes::LightByRays judge(year_of_light(60), 10000, packed.package().grid().rotation);
  expect_the_light_of_rays(packed.package(), Engine::automatic, {.light = light, .irradiation = true},
                           packed.receivers_on_square(normals_of_receivers()), judge, "without crowns");
}

TEST(IrradiationOfAYear, ThroughCrownsIsThatOfEachHourAndRay) {
  PackedAround packed(Angle::degrees(20.0), add_town);
  packed.plant(scenes::random_crowns(packed.package(), 60));
  ASSERT_TRUE(packed.package().has_crowns());
  const Light light = year_of_light();
  const scenes::LightByRays judge(year_of_light(60), 10000, packed.package().grid().rotation);
  for (const auto& [word, rule] : canopy_rule_words)
    for (const Engine engine : {Engine::automatic, Engine::exact})
      expect_the_light_of_rays(packed.package(), engine, {.light = light, .irradiation = true, .canopy = {.rule = rule}},
                               packed.receivers_on_square(normals_of_receivers()), judge, std::string(word));
}

/// A passage of .8 m between two rows of boxes of other lengths.
void add_passage(scenes::SceneBuilder& builder) {
  double y = -60.0;
  for (int n = 0; n < 12; ++n) {
    const double edge = 7.0 + 1.3 * (n % 4), height_m = 24.0 + 3.0 * (n % 5);
    builder.add_box({{-20.0, y}, {-0.4, y + edge}}, -1.5, height_m);
    builder.add_box({{0.4, y + 1.0}, {18.0, y + edge}}, -1.5, 48.0 - height_m);
    y += edge;
  }
}

TEST(IrradiationOfAYear, OfLittleSkyIsThatOfMoreAzimuths) {
  const PackedAround packed(Angle::degrees(0.0), add_passage);
  const Light light = year_of_light();
  const Quantities quantities{.light = light, .irradiation = true};
  const std::size_t columns = columns_of(quantities).size();
  CellReceivers receivers{{0, 0}, {}};
  const auto middle = static_cast<float>(0.5 * packed_cell_edge_m);
  const auto z = static_cast<float>(packed_eye_m - packed.package().manifest().height_origin_m);
  for (std::size_t n = 0; n < 9; ++n)
    receivers.receivers.push_back(
        {n, {middle - 0.2F + 0.05F * static_cast<float>(n), middle + static_cast<float>(n), z}, {0, 0, 1}});
  // One above the roofs sees more
  receivers.receivers.push_back({9, {middle, middle, z + 50.0F}, {0, 0, 1}});
  const auto evaluated = [&](std::size_t azimuths) {
    std::vector<float> svf(10), values(10 * columns);
    SkyEvaluator(packed.package(), {.azimuths = azimuths, .further = quantities})
        .evaluate(receivers, SkyAnswers(svf, {}, {}, values));
    return std::pair(svf, values);
  };
  const auto [svf, few] = evaluated(320);
  const std::vector<float> more = evaluated(LightOfLittleSky::azimuths).second;
  for (std::size_t n = 0; n < 10; ++n) {
    ASSERT_EQ(svf[n] < LightOfLittleSky::little_svf, n < 9) << n << ": " << svf[n];
    const bool are_alike = std::equal(few.begin() + static_cast<std::ptrdiff_t>(n * columns),
                                      few.begin() + static_cast<std::ptrdiff_t>((n + 1) * columns),
                                      more.begin() + static_cast<std::ptrdiff_t>(n * columns));
    EXPECT_EQ(are_alike, n < 9) << n;
  }
}

}  // namespace
}  // namespace farlod
