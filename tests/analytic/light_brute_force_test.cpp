// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "radiation/perez_sky.hpp"
#include "radiation/sky_grid.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/analytic/packed_around.hpp"

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

/// Days of mean declinations at 48° north, half of the hours clear.
Light year_of_light() {
  Light light{{}, SkyModel::perez, 0.0, 0.0};
  light.by_month = true;
  const double latitude = 48.0 * pi / 180.0;
  for (int day = 0; day < 365; ++day)
    for (int hour = 4; hour < 20; ++hour) {
      LightInterval interval{{}, 1.0};
      for (int part = 0; part < 12; ++part) {
        const double declination = -23.44 * pi / 180.0 * std::cos(2.0 * pi * (day + 10) / 365.0);
        const double turn = 2.0 * pi * (hour + (part + 0.5) / 12.0 - 12.0) / 24.0;
        const double up =
            std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(turn);
        const double west = std::cos(declination) * std::sin(turn),
                     south =
                         std::sin(latitude) * std::cos(declination) * std::cos(turn) - std::cos(latitude) * std::sin(declination);
        if (up > 0.0)
          interval.sun.push_back({Angle::radians(std::atan2(-west, -south)), Angle::radians(std::asin(up)), 1.0 / 12.0});
      }
      if (interval.sun.empty()) continue;
      const double up = sin(interval.sun[interval.sun.size() / 2].elevation);
      const bool is_clear = (day * 7 + hour / 3) % 2 == 0;
      interval.direct_normal_w_m2 = is_clear ? 950.0 * std::exp(-0.18 / std::max(up, 0.05)) : 60.0 * up;
      interval.diffuse_w_m2 = is_clear ? 30.0 + 90.0 * up : 20.0 + 330.0 * up;
      interval.month = static_cast<unsigned>(day / 31) + 1;
      light.intervals.push_back(std::move(interval));
    }
  return light;
}

struct RayOfLight {
  Point3d direction_city;
  std::vector<double> of_month;  ///< kWh/m² on a plane that faces it
};

/// Spherical Fibonacci directions, with the sky's light of all hours, and the sun's positions.
std::vector<RayOfLight> rays_of_sky(const Light& light, std::size_t count) {
  std::vector<RayOfLight> rays;
  for (std::size_t n = 0; n < count; ++n) {
    const double up = (static_cast<double>(n) + 0.5) / static_cast<double>(count), level = std::sqrt(1.0 - up * up);
    const double turn = 2.0 * pi * std::fmod(static_cast<double>(n) * (2.0 - std::numbers::phi), 1.0);
    rays.push_back({{level * std::sin(turn), level * std::cos(turn), up}, std::vector<double>(12)});
  }
  std::vector<double> relative(count);
  for (const LightInterval& interval : light.intervals) {
    const SunPosition sun = *mean_sun(interval);
    // Means are of all of the hour
    const double share = interval.hours / sun.hours;
    const PerezSky sky(
        sky_state(Angle::degrees(90.0) - sun.elevation,
                  {share * interval.diffuse_w_m2, share * interval.direct_normal_w_m2, interval.extraterrestrial_w_m2}));
    const Point3d to_sun{cos(sun.elevation) * sin(sun.azimuth), cos(sun.elevation) * cos(sun.azimuth), sin(sun.elevation)};
    double on_level = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
      const Point3d& d = rays[n].direction_city;
      relative[n] =
          sky.radiance(Angle::radians(std::acos(d.z)), Angle::radians(std::acos(std::clamp(dot(d, to_sun), -1.0, 1.0))));
      on_level += relative[n] * d.z;
    }
    const double scale = energy_kwh_m2(interval.diffuse_w_m2, interval.hours) / on_level;
    for (std::size_t n = 0; n < count; ++n) rays[n].of_month[interval.month - 1] += scale * relative[n];
  }
  return rays;
}

std::vector<RayOfLight> rays_of_sun(const Light& light) {
  std::vector<RayOfLight> rays;
  for (const LightInterval& interval : light.intervals)
    for (const SunPosition& sun : interval.sun) {
      RayOfLight ray{{cos(sun.elevation) * sin(sun.azimuth), cos(sun.elevation) * cos(sun.azimuth), sin(sun.elevation)},
                     std::vector<double>(12)};
      ray.of_month[interval.month - 1] =
          energy_kwh_m2(interval.direct_normal_w_m2, interval.hours) / static_cast<double>(interval.sun.size());
      rays.push_back(std::move(ray));
    }
  return rays;
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

/// What the sun, seen past an edge between two azimuths, may add or lack in a month.
constexpr double of_edges_kwh_m2 = 0.1;

TEST(IrradiationOfAYear, IsThatOfEachHourAndRay) {
  const Angle bearing = Angle::degrees(20.0);
  const PackedAround packed(bearing, add_town);
  const Light light = year_of_light();
  const Quantities quantities{.light = light, .irradiation = true};
  const std::vector<RayOfLight> sky = rays_of_sky(light, 10000), sun = rays_of_sun(light);
  const WholeCity city(packed.package());
  const CellReceivers receivers = packed.receivers_on_square(normals_of_receivers());
  const std::size_t columns = columns_of(quantities).size();
  std::vector<float> svf(receivers.receivers.size()), values(svf.size() * columns);
  SkySettings settings{.engine = Engine::automatic, .further = quantities};
  SkyEvaluator(packed.package(), settings).evaluate(receivers, SkyAnswers(svf, {}, {}, values));
  const GridRotation& rotation = packed.package().grid().rotation;
  for (const Receiver& r : receivers.receivers) {
    const Point3f origin = city.scene_from_cell(r.p_cell, {0, 0});
    const Point3d normal{r.normal.x, r.normal.y, r.normal.z};
    std::vector<double> months(12);
    double year = 0.0;
    for (const std::vector<RayOfLight>* rays : {&sky, &sun})
      for (const RayOfLight& ray : *rays) {
        const Point3d direction = rotation.grid_from_city(ray.direction_city);
        const double cosine = dot(direction, normal);
        if (cosine <= 0.0 || city.occluder().blocks({origin,
                                                     {static_cast<float>(direction.x), static_cast<float>(direction.y),
                                                      static_cast<float>(direction.z)},
                                                     1e-3F}))
          continue;
        for (std::size_t m = 0; m < months.size(); ++m) months[m] += cosine * ray.of_month[m];
      }
    for (const double month : months) year += month;
    const float* const got = &values[r.index * columns];
    EXPECT_NEAR(got[0], year, 0.005 * year) << "receiver " << r.index << ", svf " << svf[r.index];
    for (std::size_t m = 0; m < months.size(); ++m)
      EXPECT_NEAR(got[4 + m], months[m], 0.01 * months[m] + of_edges_kwh_m2) << "receiver " << r.index << ", month " << m + 1;
  }
}

}  // namespace
}  // namespace farlod
