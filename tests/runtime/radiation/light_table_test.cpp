// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/light_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>

#include "farlod/point.hpp"
#include "radiation/perez_sky.hpp"
#include "radiation/sky_grid.hpp"

namespace farlod {
namespace {

using std::numbers::pi;

std::vector<double> turns(std::size_t count = 320) {
  std::vector<double> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(count));
  return result;
}

/// East, north, up.
Point3d tilted(double tilt_deg, double azimuth_deg) {
  const Angle tilt = Angle::degrees(tilt_deg), azimuth = Angle::degrees(azimuth_deg);
  return {sin(tilt) * sin(azimuth), sin(tilt) * cos(azimuth), cos(tilt)};
}

LightTable table_of(const Light& light, std::span<const double> at) { return {LightOfPeriod(light, false), at}; }

/// What falls on a plane above a horizon that is even.
std::vector<float> on_plane(const LightTable& table, const std::vector<double>& at, const Point3d& normal,
                            double horizon_slope = 0.0) {
  std::array<LightPair, LightTable::most_pairs> sums{};
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double turn = 2.0 * pi * at[k];
    const double outward = normal.x * std::sin(turn) + normal.y * std::cos(turn);
    // o + w t > 0
    double from = horizon_slope;
    if (outward <= 0.0) from = normal.z > 1e-9 ? std::max(from, -outward / normal.z) : 1e9;
    table.add_above(k, LightTable::place_of(static_cast<float>(from)), static_cast<float>(outward), static_cast<float>(normal.z),
                    sums.data());
  }
  std::vector<float> layers;
  for (std::size_t n = 0; n < table.layers(); ++n) layers.push_back(light_of_layer(sums.data(), n));
  return layers;
}

constexpr auto direct = static_cast<std::size_t>(LightLayer::direct), diffuse = static_cast<std::size_t>(LightLayer::diffuse),
               overcast = static_cast<std::size_t>(LightLayer::overcast), uniform = static_cast<std::size_t>(LightLayer::uniform);

LightInterval hour(double azimuth_deg, double elevation_deg, double direct_normal_w_m2, double diffuse_w_m2, unsigned month = 6) {
  LightInterval interval{{{Angle::degrees(azimuth_deg), Angle::degrees(elevation_deg), 1.0}}, 1.0};
  interval.direct_normal_w_m2 = direct_normal_w_m2;
  interval.diffuse_w_m2 = diffuse_w_m2;
  interval.month = month;
  return interval;
}

/// Skies from dull to clear.
Light some_hours(SkyModel model) {
  Light light{{hour(100, 12, 40, 90, 1), hour(150, 35, 420, 200, 2), hour(181, 52, 800, 110, 6), hour(250, 20, 0, 140, 6),
               hour(290, 8, 350, 60, 11)}};
  light.sky_model = model;
  return light;
}

/// Azimuths of 1.1° meet the border of a tilted plane at their middles.
constexpr double of_azimuths = 1e-4;

TEST(LightTable, OfAnIsotropicSkyGivesTiltedPlanesTheirShare) {
  const std::vector<double> at = turns();
  const LightTable table = table_of(some_hours(SkyModel::isotropic), at);
  EXPECT_NEAR(table.on_level()[diffuse], 0.6, 1e-6);
  for (const double tilt : {0.0, 20.0, 45.0, 70.0, 90.0}) {
    const std::vector<float> sums = on_plane(table, at, tilted(tilt, 33.0));
    const double share = 0.5 * (1.0 + std::cos(tilt * pi / 180.0));
    EXPECT_NEAR(sums[diffuse], 0.6 * share, of_azimuths) << tilt;
    EXPECT_NEAR(sums[uniform], share, of_azimuths) << tilt;
  }
  EXPECT_NEAR(table.on_upright()[diffuse], 0.3, 1e-5);
}

TEST(LightTable, OfABasinIsotropicIsTheSquareOfItsCosine) {
  const std::vector<double> at = turns(8);
  const LightTable table = table_of(some_hours(SkyModel::isotropic), at);
  for (const double horizon_deg : {5.0, 30.0, 45.0, 80.0, 89.0})
    EXPECT_NEAR(on_plane(table, at, {0, 0, 1}, std::tan(horizon_deg * pi / 180.0))[uniform],
                std::pow(std::cos(horizon_deg * pi / 180.0), 2), 2e-5)
        << horizon_deg;
}

/// ∫ l max(0, n · ω) dω / ∫ l ω_z dω of one hour's sky, in steps of half a degree.
double perez_share_by_quadrature(const LightInterval& interval, const Point3d& normal) {
  const SunPosition sun = interval.sun.front();
  const PerezSky sky(sky_state(Angle::degrees(90.0) - sun.elevation,
                               {interval.diffuse_w_m2, interval.direct_normal_w_m2, interval.extraterrestrial_w_m2}));
  const Point3d to_sun{cos(sun.elevation) * sin(sun.azimuth), cos(sun.elevation) * cos(sun.azimuth), sin(sun.elevation)};
  double on_plane = 0.0, on_level = 0.0;
  for (double e = 0.25; e < 90.0; e += 0.5)
    for (double a = 0.25; a < 360.0; a += 0.5) {
      const Angle elevation = Angle::degrees(e), azimuth = Angle::degrees(a);
      const Point3d d{cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation)};
      const double light =
          cos(elevation) * sky.radiance(Angle::degrees(90.0 - e), Angle::radians(std::acos(std::min(1.0, dot(d, to_sun)))));
      on_plane += light * std::max(0.0, dot(d, normal));
      on_level += light * d.z;
    }
  return on_plane / on_level;
}

TEST(LightTable, OfThePerezSkyIsItsQuadrature) {
  const std::vector<double> at = turns();
  for (const LightInterval& interval : some_hours(SkyModel::perez).intervals) {
    Light light{{interval}};
    const LightTable table = table_of(light, at);
    EXPECT_NEAR(table.on_level()[diffuse], interval.diffuse_w_m2 / 1000.0, 1e-6);
    for (const double tilt : {0.0, 30.0, 60.0, 90.0})
      for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
        const Point3d normal = tilted(tilt, azimuth);
        const double expected = 0.001 * interval.diffuse_w_m2 * perez_share_by_quadrature(interval, normal);
        // Bins of 2.5° flatten the sky around the sun
        EXPECT_NEAR(on_plane(table, at, normal)[diffuse], expected, 0.005 * expected + 1e-5)
            << interval.diffuse_w_m2 << " " << tilt << " " << azimuth;
      }
  }
}

TEST(LightTable, OfTheSunIsTheCosineOfEachPlane) {
  const std::vector<double> at = turns();
  const LightTable table = table_of(Light{{hour(170.3, 41.0, 800.0, 0.0)}}, at);
  const Point3d sun{std::cos(41.0 * pi / 180) * std::sin(170.3 * pi / 180),
                    std::cos(41.0 * pi / 180) * std::cos(170.3 * pi / 180), std::sin(41.0 * pi / 180)};
  for (const double tilt : {0.0, 30.0, 60.0, 90.0})
    for (const double azimuth : {90.0, 135.0, 180.0, 225.0}) {
      const Point3d normal = tilted(tilt, azimuth);
      // Between two azimuths a cosine is interpolated: (1.1° in radians)² / 8
      EXPECT_NEAR(on_plane(table, at, normal)[direct], 0.8 * std::max(0.0, dot(sun, normal)), 0.8 * 5e-5 + 1e-6);
    }
  // Horizons below and above the disk, and in its middle: knots are .45° apart there
  const auto above = [&](double deg) { return on_plane(table, at, {0, 0, 1}, std::tan(deg * pi / 180.0))[direct]; };
  EXPECT_FLOAT_EQ(above(39.8), above(0.0));
  EXPECT_EQ(above(42.2), 0.0F);
  EXPECT_NEAR(above(41.0), 0.5 * above(0.0), 0.05 * above(0.0));
}

/// An hour around noon, of so many positions of the sun.
LightInterval hour_of_positions(std::size_t count) {
  LightInterval interval = hour(180.0, 50.0, 700.0, 0.0);
  interval.sun.clear();
  for (std::size_t n = 0; n < count; ++n) {
    const double on = (static_cast<double>(n) + 0.5) / static_cast<double>(count) - 0.5;
    interval.sun.push_back(
        {Angle::degrees(180.0 + 20.0 * on), Angle::degrees(50.0 - 3.0 * on), 1.0 / static_cast<double>(count)});
  }
  return interval;
}

TEST(LightTable, TheSunGoesOnBetweenItsPositions) {
  // At each azimuth, four positions of an hour tell what sixty do; by themselves they would leave most azimuths without sun
  const std::vector<double> at = turns();
  const LightTable few = table_of(Light{{hour_of_positions(4)}}, at), many = table_of(Light{{hour_of_positions(60)}}, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    std::array<LightPair, LightTable::most_pairs> of_few{}, of_many{};
    few.add_above(k, LightTable::place_of(0.0F), 0.0F, 1.0F, of_few.data());
    many.add_above(k, LightTable::place_of(0.0F), 0.0F, 1.0F, of_many.data());
    EXPECT_NEAR(light_of_layer(of_few.data(), direct), light_of_layer(of_many.data(), direct), 0.05 * 0.7 / 18.0) << k;
  }
}

TEST(LightTable, TheSunGoesOnFromStepToStepAndNotFromDayToDay) {
  // Two steps of a quarter of an hour, one after the other or a day apart
  const std::vector<double> at = turns();
  const auto steps = [](std::chrono::minutes apart) {
    LightInterval first = hour(170.0, 40.0, 800.0, 0.0), second = hour(175.0, 40.0, 800.0, 0.0);
    first.hours = second.hours = first.sun[0].hours = second.sun[0].hours = 0.25;
    second.begin = first.begin + apart;
    return Light{{first, second}};
  };
  const auto lit_azimuths = [&](const Light& light) {
    const LightTable table = table_of(light, at);
    std::size_t lit = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      std::array<LightPair, LightTable::most_pairs> sums{};
      table.add_above(k, LightTable::place_of(0.0F), 0.0F, 1.0F, sums.data());
      lit += light_of_layer(sums.data(), direct) > 0.0F ? 1 : 0;
    }
    return lit;
  };
  EXPECT_EQ(lit_azimuths(steps(std::chrono::hours(24))), 4U);  // each between two azimuths
  EXPECT_GE(lit_azimuths(steps(std::chrono::minutes(15))), 9U);
}

TEST(LightTable, TheEnergyOfAnHourIsKeptWhileTheSunRises) {
  LightInterval interval = hour(90, 2, 300, 30);
  interval.sun = {{Angle::degrees(88), Angle::degrees(-0.5), 0.5}, {Angle::degrees(90), Angle::degrees(2), 0.5}};
  const LightTable table = table_of(Light{{interval}}, turns());
  EXPECT_NEAR(table.on_level()[direct], 0.3 * std::sin(2.0 * pi / 180.0), 1e-7);
  EXPECT_NEAR(table.on_level()[diffuse], 0.03, 1e-7);
}

TEST(LightTable, MonthsHaveTheLightOfTheirHours) {
  Light light = some_hours(SkyModel::perez);
  const LightTable all = table_of(light, turns());
  light.by_month = true;
  const LightTable table = table_of(light, turns());
  ASSERT_EQ(std::vector<unsigned>(table.months().begin(), table.months().end()), (std::vector<unsigned>{1, 2, 6, 11}));
  const std::array<double, 4> diffuse_of_month{0.09, 0.2, 0.25, 0.06};
  for (std::size_t n = 0; n < diffuse_of_month.size(); ++n) EXPECT_NEAR(table.diffuse_of_totals()[n], diffuse_of_month[n], 1e-6);
  for (const auto& on_plane : {table.on_level(), table.on_upright()}) {
    float of_months = 0.0F;
    for (std::size_t n = 0; n < table.months().size(); ++n)
      of_months += on_plane[static_cast<std::size_t>(LightLayer::first_total) + n];
    EXPECT_NEAR(of_months, on_plane[direct] + on_plane[diffuse], 1e-6);
  }
  EXPECT_NEAR(table.on_level()[direct], all.on_level()[direct], 1e-6);
  EXPECT_NEAR(table.on_upright()[diffuse], all.on_upright()[diffuse], 1e-6);
  EXPECT_DOUBLE_EQ(table.hours(), 5.0);
}

TEST(LightTable, OfManyHoursIsTheSumOfEach) {
  const std::vector<double> at = turns();
  const Light light = some_hours(SkyModel::perez);
  const Point3d normal = tilted(60.0, 110.0);
  double direct_sum = 0.0, diffuse_sum = 0.0;
  for (const LightInterval& interval : light.intervals) {
    const std::vector<float> sums = on_plane(table_of(Light{{interval}}, at), at, normal);
    direct_sum += sums[direct];
    diffuse_sum += sums[diffuse];
  }
  const std::vector<float> sums = on_plane(table_of(light, at), at, normal);
  EXPECT_NEAR(sums[direct], direct_sum, 1e-5);
  EXPECT_NEAR(sums[diffuse], diffuse_sum, 1e-5);
}

/// Steps of five minutes, each with a sun of its own, from so many seconds after midnight.
std::vector<LightInterval> steps_from(int begin_s, std::initializer_list<double> elevations_deg) {
  std::vector<LightInterval> steps;
  for (const double elevation_deg : elevations_deg) {
    LightInterval step = hour(100.0 + elevation_deg, elevation_deg, 400.0 + 10.0 * elevation_deg, 90.0 + elevation_deg);
    step.hours = step.sun.front().hours = 1.0 / 12.0;
    step.begin = std::chrono::local_seconds(std::chrono::seconds(begin_s + 300 * static_cast<int>(steps.size())));
    steps.push_back(step);
  }
  return steps;
}

TEST(LightTable, StepsOfAQuarterOfAnHourShareTheirSky) {
  const std::vector<double> at = turns();
  const std::vector<LightInterval> steps = steps_from(36'000, {20.0, 21.0, 22.0});
  LightInterval quarter = steps[1];
  quarter.sun = {steps[0].sun[0], steps[1].sun[0], steps[2].sun[0]};
  quarter.hours = 0.25;
  const LightTable of_steps = table_of(Light{steps}, at), of_quarter = table_of(Light{{quarter}}, at);
  for (const double azimuth_deg : {10.0, 120.0, 200.0}) {
    const Point3d normal = tilted(70.0, azimuth_deg);
    EXPECT_NEAR(on_plane(of_steps, at, normal)[diffuse], on_plane(of_quarter, at, normal)[diffuse], 1e-7) << azimuth_deg;
  }
  double in_all = 0.0;
  for (const LightInterval& step : steps) in_all += 1e-3 * step.diffuse_w_m2 * step.hours;
  EXPECT_NEAR(of_steps.on_level()[diffuse], in_all, 1e-7);
}

/// A gap between two steps, and the end of a quarter.
TEST(LightTable, OtherStepsHaveSkiesOfTheirOwn) {
  const std::vector<double> at = turns();
  const Point3d normal = tilted(70.0, 120.0);
  std::vector<LightInterval> steps = steps_from(36'000, {20.0, 21.0, 22.0, 60.0});
  const std::vector<LightInterval> later = steps_from(40'000, {10.0});
  steps.insert(steps.end(), later.begin(), later.end());
  const auto on_tilted = [&](std::vector<LightInterval> some) {
    return on_plane(table_of(Light{std::move(some)}, at), at, normal)[diffuse];
  };
  EXPECT_NEAR(on_tilted(steps), on_tilted({steps[0], steps[1], steps[2]}) + on_tilted({steps[3]}) + on_tilted(later), 1e-6);
}

TEST(LightTable, AWallInTheOpenHasTheVerticalSkyComponentOfTheCode) {
  const std::vector<double> at = turns();
  const LightTable table = table_of(Light{}, at);
  EXPECT_NEAR(table.on_level()[overcast], 1.0, 1e-6);
  // 3/14 + 4/7π: "just under 40 %" (BRE 209)
  EXPECT_NEAR(on_plane(table, at, tilted(90, 10))[overcast], 3.0 / 14.0 + 4.0 / (7.0 * pi), of_azimuths);
}

TEST(SkyGrid, TheLightOfTheNightComesFromEverywhere) {
  LightInterval dusk{{}, 1.0};
  dusk.diffuse_w_m2 = 10.0;
  SkyGrid sky;
  sky.add(dusk, SkyModel::perez);
  EXPECT_DOUBLE_EQ(sky.on_level(), 0.01);
  EXPECT_DOUBLE_EQ(sky.radiance(0.3, Angle::degrees(70)), 0.01 / pi);
}

}  // namespace
}  // namespace farlod
