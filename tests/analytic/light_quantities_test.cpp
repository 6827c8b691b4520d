// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "radiation/perez_sky.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/packed_around.hpp"

// What falls on receivers in a period, against closed forms and quadratures, by horizons and by rays.

namespace farlod {
namespace {

using std::numbers::pi;

constexpr std::array engines_of_light{Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};

/// Of azimuths, of rays, and of knots of the table.
constexpr double tolerance_of_light = 0.003;

LightInterval hour_of(double azimuth_deg, double elevation_deg, double direct_normal_w_m2, double diffuse_w_m2) {
  LightInterval interval{{{Angle::degrees(azimuth_deg), Angle::degrees(elevation_deg), 1.0}}, 1.0};
  interval.direct_normal_w_m2 = direct_normal_w_m2;
  interval.diffuse_w_m2 = diffuse_w_m2;
  return interval;
}

Quantities irradiation_of(const LightInterval& interval, SkyModel model = SkyModel::isotropic) {
  Quantities quantities{.light = Light{{interval}, model, 0.0, 0.0}, .irradiation = true};
  return quantities;
}

Point3d tilted_normal(double tilt_deg, double azimuth_deg) {
  const Angle tilt = Angle::degrees(tilt_deg), azimuth = Angle::degrees(azimuth_deg);
  return {sin(tilt) * sin(azimuth), sin(tilt) * cos(azimuth), cos(tilt)};
}

/// Walls along the north.
struct Street {
  double height_m = 20.0, east_m = 6.0, west_m = 9.0;

  auto walls() const {
    return [s = *this](scenes::SceneBuilder& builder) {
      for (const double x : {s.east_m, -s.west_m}) builder.add_wall({x, -900.0}, {x, 900.0}, -packed_eye_m, s.height_m);
    };
  }
  [[nodiscard]] double svf() const {
    return 0.5 * (std::cos(std::atan2(height_m, east_m)) + std::cos(std::atan2(height_m, west_m)));
  }
};

TEST(Irradiation, OfTiltedPlanesInTheOpenIsTheirShareOfAnIsotropicSky) {
  const PackedAround open(Angle::degrees(20.0), [](scenes::SceneBuilder&) {});
  const Quantities quantities = irradiation_of(hour_of(180, 40, 0, 1000));
  for (const Engine engine : engines_of_light)
    for (const double tilt : {0.0, 25.0, 60.0, 90.0, 120.0}) {
      const auto got = open.columns(engine, quantities, tilted_normal(tilt, 77.0));
      EXPECT_NEAR(got.at("irradiation_diffuse"), 0.5 * (1.0 + std::cos(tilt * pi / 180.0)), tolerance_of_light) << tilt;
      EXPECT_EQ(got.at("irradiation_direct"), 0.0);
      EXPECT_EQ(got.at("irradiation"), got.at("irradiation_diffuse"));
    }
}

TEST(Irradiation, OfAStreetUnderAnIsotropicSkyIsItsSkyViewFactor) {
  const Street street;
  const PackedAround packed({}, street.walls());
  for (const Engine engine : engines_of_light) {
    const auto got = packed.columns(engine, irradiation_of(hour_of(180, 40, 0, 1000)));
    EXPECT_NEAR(got.at("irradiation_diffuse"), street.svf(), tolerance_of_light);
    // Light is interpolated between the knots of its table, the uniform sky is not
    EXPECT_NEAR(got.at("irradiation_diffuse"), got.at("svf"), 1e-5);
  }
}

/// ∫ l ω_z dω of what a street shows of a sky, as a share of all of it.
double seen_of_perez(const Street& street, const LightInterval& interval) {
  const SunPosition& sun = interval.sun.front();
  const PerezSky sky(sky_state(Angle::degrees(90.0) - sun.elevation,
                               {interval.diffuse_w_m2, interval.direct_normal_w_m2, interval.extraterrestrial_w_m2}));
  const Point3d to_sun{cos(sun.elevation) * sin(sun.azimuth), cos(sun.elevation) * cos(sun.azimuth), sin(sun.elevation)};
  double seen = 0.0, all = 0.0;
  for (double e = 0.25; e < 90.0; e += 0.5)
    for (double a = 0.25; a < 360.0; a += 0.5) {
      const Angle elevation = Angle::degrees(e), azimuth = Angle::degrees(a);
      const Point3d d{cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation)};
      const double light =
          cos(elevation) * d.z * sky.radiance(Angle::degrees(90.0 - e), Angle::radians(std::acos(std::min(1.0, dot(d, to_sun)))));
      all += light;
      const double wall_m = d.x > 0.0 ? street.east_m : street.west_m;
      if (d.z * wall_m > street.height_m * std::abs(d.x)) seen += light;
    }
  return seen / all;
}

TEST(Irradiation, OfAStreetUnderThePerezSkyIsItsQuadrature) {
  const Street street;
  const PackedAround packed({}, street.walls());
  // The sun above the street, and behind a wall
  for (const LightInterval& interval : {hour_of(181, 52, 800, 1000), hour_of(95, 25, 300, 1000)})
    for (const Engine engine : engines_of_light)
      EXPECT_NEAR(packed.columns(engine, irradiation_of(interval, SkyModel::perez)).at("irradiation_diffuse"),
                  seen_of_perez(street, interval), 2.0 * tolerance_of_light);
}

TEST(Irradiation, OfTheSunIsTheCosineUnlessAWallStandsBefore) {
  const Street street;
  const PackedAround packed({}, street.walls());
  const double cut_off_deg = std::atan2(street.height_m, street.east_m) * 180.0 / pi;
  for (const Engine engine : engines_of_light) {
    // A wall that looks at the wall in the east
    for (const double above_deg : {-1.5, -0.7, 0.7, 1.5}) {
      const double elevation_deg = cut_off_deg + above_deg;
      const auto got = packed.columns(engine, irradiation_of(hour_of(90, elevation_deg, 1000, 0)), {1.0, 0.0, 0.0});
      EXPECT_NEAR(got.at("irradiation_direct"), above_deg > 0.0 ? std::cos(elevation_deg * pi / 180.0) : 0.0, 1e-3) << above_deg;
    }
    // The sun of an equinox's noon, along the street
    const auto noon = packed.columns(engine, irradiation_of(hour_of(180, 40, 1000, 0)));
    EXPECT_NEAR(noon.at("irradiation_direct"), std::sin(40.0 * pi / 180.0), 1e-3);
  }
}

TEST(Irradiation, BelowARoofComesThroughTheGap) {
  // A roof without walls, 13 m wide on each side and 1.5 m above the eye: open below 6.6° in the south
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) { builder.add_box({{-13.0, -13.0}, {13.0, 13.0}}, 1.5, 2.0); });
  for (const Engine engine : {Engine::automatic, Engine::exact}) {
    EXPECT_NEAR(packed.columns(engine, irradiation_of(hour_of(180, 3, 1000, 0))).at("irradiation_direct"),
                std::sin(3.0 * pi / 180.0), 0.1 * std::sin(3.0 * pi / 180.0));
    EXPECT_EQ(packed.columns(engine, irradiation_of(hour_of(180, 20, 1000, 0))).at("irradiation_direct"), 0.0);
  }
}

TEST(Irradiation, IsReflectedOnceByWhatIsNotSky) {
  Quantities quantities = irradiation_of(hour_of(180, 30, 800, 100));
  quantities.light->ground_albedo = 0.3;
  quantities.light->facade_albedo = 0.5;
  const double level = 0.8 * 0.5 + 0.1, upright = 0.8 * std::cos(pi / 6.0) / pi + 0.05;
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  const Street street;
  const PackedAround packed({}, street.walls());
  for (const Engine engine : engines_of_light) {
    const auto wall = open.columns(engine, quantities, {0.0, 1.0, 0.0});
    EXPECT_NEAR(wall.at("irradiation_reflected"), 0.5 * 0.3 * level, 1e-3);
    const auto ground = packed.columns(engine, quantities);
    EXPECT_NEAR(ground.at("irradiation_reflected"), (1.0 - street.svf()) * 0.5 * upright, 1e-3);
    EXPECT_NEAR(ground.at("irradiation"),
                ground.at("irradiation_direct") + ground.at("irradiation_diffuse") + ground.at("irradiation_reflected"), 1e-6);
  }
}

TEST(Irradiation, OfMonthsAddsUpToThatOfThePeriod) {
  Quantities quantities = irradiation_of(hour_of(180, 60, 500, 200), SkyModel::perez);
  LightInterval other = hour_of(95, 25, 300, 100);
  other.month = 11;
  quantities.light->intervals.push_back(other);
  quantities.light->by_month = true;
  quantities.light->ground_albedo = 0.2;
  quantities.light->facade_albedo = 0.2;
  const Street street;
  const PackedAround packed({}, street.walls());
  for (const Engine engine : engines_of_light) {
    const auto got = packed.columns(engine, quantities);
    EXPECT_NEAR(got.at("irradiation_01") + got.at("irradiation_11"), got.at("irradiation"), 1e-5);
    EXPECT_GT(got.at("irradiation_11"), 0.0);
  }
}

/// Receivers on the inner sides of a box without a lid, 10 m wide and 8 m high, whose floor lies 1.5 m below the eye: in the
/// middles of equal parts, 1 cm before them.
CellReceivers in_open_box(double floor_z_cell, std::size_t parts) {
  constexpr double edge_m = 10.0, height_m = 8.0, off_m = 0.01, middle_m = 0.5 * packed_cell_edge_m;
  CellReceivers result{{0, 0}, {}};
  const auto add = [&](double x, double y, double z, const Point3f& normal) {
    const Point3f place{static_cast<float>(middle_m + x), static_cast<float>(middle_m + y), static_cast<float>(floor_z_cell + z)};
    result.receivers.push_back({result.receivers.size(), place, normal});
  };
  const double inside_m = 0.5 * edge_m - off_m;
  for (std::size_t i = 0; i < parts; ++i)
    for (std::size_t j = 0; j < parts; ++j) {
      const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(parts),
                   v = (static_cast<double>(j) + 0.5) / static_cast<double>(parts);
      const double along = edge_m * (u - 0.5), up = height_m * v;
      add(along, edge_m * (v - 0.5), off_m, {0.0F, 0.0F, 1.0F});
      add(along, -inside_m, up, {0.0F, 1.0F, 0.0F});
      add(along, inside_m, up, {0.0F, -1.0F, 0.0F});
      add(-inside_m, along, up, {1.0F, 0.0F, 0.0F});
      add(inside_m, along, up, {-1.0F, 0.0F, 0.0F});
    }
  return result;
}

TEST(Irradiation, OfAllSidesOfAnOpenBoxIsWhatEntersIt) {
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    const std::array<Point2d, 4> corners{{{-5.0, -5.0}, {5.0, -5.0}, {5.0, 5.0}, {-5.0, 5.0}}};
    for (std::size_t n = 0; n < 4; ++n) builder.add_wall(corners[n], corners[(n + 1) % 4], -packed_eye_m, 8.0 - packed_eye_m);
  });
  constexpr std::size_t parts = 16;
  const CellReceivers receivers = in_open_box(-packed.package().manifest().height_origin_m, parts);
  const Quantities quantities = irradiation_of(hour_of(180, 40, 0, 1000));
  const std::size_t columns = columns_of(quantities).size();
  std::vector<float> svf(receivers.receivers.size()), values(svf.size() * columns);
  const SkySettings settings{.engine = Engine::automatic, .further = quantities};
  SkyEvaluator(packed.package(), settings).evaluate(receivers, SkyAnswers(svf, {}, {}, values));
  double sum = 0.0;
  for (const Receiver& r : receivers.receivers)
    sum += (r.normal.z > 0.0F ? 100.0 : 80.0) / (parts * parts) * static_cast<double>(values[r.index * columns]);
  EXPECT_NEAR(sum, 100.0, 0.5);
}

TEST(Irradiance, IsTheMeanOfIrradiation) {
  Quantities quantities = irradiation_of(hour_of(180, 60, 500, 200));
  LightInterval night{{}, 3.0};
  quantities.light->intervals.push_back(night);
  quantities.irradiance = true;
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  const auto got = open.columns(Engine::automatic, quantities);
  EXPECT_NEAR(got.at("irradiance"), 1000.0 * got.at("irradiation") / 4.0, 1e-3);
}

TEST(Shade, IsTheShareOfTheHoursOfSun) {
  Quantities quantities = irradiation_of(hour_of(90, 40, 0, 0));  // behind the wall
  quantities.irradiation = false;
  quantities.shade = true;
  LightInterval noon = hour_of(180, 40, 0, 0);
  noon.sun.front().hours = 3.0;
  quantities.light->intervals.push_back(noon);
  const Street street;
  const PackedAround packed({}, street.walls());
  for (const Engine engine : engines_of_light) EXPECT_NEAR(packed.columns(engine, quantities).at("shade"), 0.25, 1e-6);
  quantities.light->intervals.clear();
  EXPECT_TRUE(std::isnan(packed.columns(Engine::automatic, quantities).at("shade")));
}

TEST(SkyComponent, OfAWallInTheOpenIsThatOfTheCode) {
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  const Quantities quantities{.sky_component = true};
  for (const Engine engine : engines_of_light) {
    EXPECT_NEAR(open.columns(engine, quantities).at("sky_component"), 1.0, 1e-5);
    EXPECT_NEAR(open.columns(engine, quantities, {1.0, 0.0, 0.0}).at("sky_component"), 3.0 / 14.0 + 4.0 / (7.0 * pi),
                tolerance_of_light);
  }
}

/// A round crown 10 m to the south, from 24° to 37° of elevation, seen from the middle.
void plant_to_the_south(PackedAround& packed) {
  const package::Manifest& manifest = packed.package().manifest();
  CrownsOfCity crowns(manifest.grid, manifest.height_origin_m);
  const Point2d receiver_grid{0.5 * packed_cell_edge_m, 0.5 * packed_cell_edge_m};
  crowns.add(receiver_grid + manifest.grid.rotation.grid_from_city(Point2d{0.0, -10.0}), packed_eye_m + 4.5, packed_eye_m + 7.5,
             1.5, CrownShape::spheroid, Foliage::unknown, 0.0);
  packed.plant(std::move(crowns));
}

TEST(Irradiation, OfTheSunBehindACrownIsWhatPassesIt) {
  PackedAround packed(Angle::degrees(20.0), [](scenes::SceneBuilder&) {});
  plant_to_the_south(packed);
  for (const Engine engine : engines_of_light)
    for (const auto& [azimuth_deg, elevation_deg, passes] : {std::tuple(180.0, 31.0, 0.03), std::tuple(180.0, 60.0, 1.0),
                                                             std::tuple(180.0, 10.0, 1.0), std::tuple(0.0, 31.0, 1.0)}) {
      Quantities quantities = irradiation_of(hour_of(azimuth_deg, elevation_deg, 1000, 0));
      quantities.shade = quantities.sunlit_total = true;
      quantities.sun = quantities.light->intervals.front().sun;
      const auto got = packed.columns(engine, quantities);
      EXPECT_NEAR(got.at("irradiation_direct"), passes * std::sin(elevation_deg * pi / 180.0), tolerance_of_light);
      EXPECT_NEAR(got.at("shade"), 1.0 - passes, 1e-6);
      EXPECT_NEAR(got.at("sunlit_h"), quantities.sun->front().hours, 1e-6);
      EXPECT_NEAR(got.at("sunlit_total_h"), passes * quantities.sun->front().hours, 1e-6);
    }
}

TEST(Irradiation, OfAnIsotropicSkyBehindCrownsIsItsShareThatPasses) {
  PackedAround packed(Angle::degrees(20.0), [](scenes::SceneBuilder&) {});
  plant_to_the_south(packed);
  for (const auto& [word, rule] : canopy_rule_words)
    for (const double tilt_deg : {0.0, 50.0}) {
      Quantities quantities = irradiation_of(hour_of(180, 40, 0, 1000));
      quantities.svf_total = true;
      quantities.canopy.rule = rule;
      const auto got = packed.columns(Engine::automatic, quantities, tilted_normal(tilt_deg, 170.0));
      EXPECT_LT(got.at("svf_total"), got.at("svf") - 0.005);
      EXPECT_NEAR(got.at("irradiation_diffuse"), got.at("svf_total"), 2e-4) << word;
    }
}

TEST(Illuminance, IsTheLightOfHoursThatKnowIt) {
  const PackedAround open(Angle::degrees(20.0), [](scenes::SceneBuilder&) {});
  LightInterval bright = hour_of(180, 40, 500, 200), unknown = bright;
  bright.direct_normal_lux = 50'000.0;
  bright.diffuse_lux = 24'000.0;
  const Quantities quantities{.light = Light{{bright, unknown}, SkyModel::isotropic, 0.0, 0.0}, .illuminance = true};
  for (const Engine engine : engines_of_light)
    EXPECT_NEAR(open.columns(engine, quantities).at("illuminance"), 50'000.0 * std::sin(40.0 * pi / 180.0) + 24'000.0,
                56'000.0 * tolerance_of_light);
}

TEST(Shade, ByStepsIsThatOfEachInterval) {
  const Street street;
  const PackedAround packed({}, street.walls());
  LightInterval morning = hour_of(90, 50, 500, 0), noon = hour_of(180, 50, 500, 0), night;
  morning.begin = std::chrono::local_days(std::chrono::year(2026) / 6 / 21) + std::chrono::hours(9);
  noon.begin = morning.begin + std::chrono::hours(3);
  Light light{{night, morning, noon}, SkyModel::isotropic, 0.0, 0.0};
  light.by_step = true;
  for (const Engine engine : engines_of_light) {
    const auto got = packed.columns(engine, {.light = light, .shade = true});
    EXPECT_EQ(got.size(), 4U);
    EXPECT_EQ(got.at("shade"), 0.5);
    EXPECT_EQ(got.at("shade_20260621T0900"), 1.0);
    EXPECT_EQ(got.at("shade_20260621T1200"), 0.0);
  }
}

}  // namespace
}  // namespace farlod
