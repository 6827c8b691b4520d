// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/light_by_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "radiation/perez_sky.hpp"
#include "radiation/sky_grid.hpp"

namespace farlod::scenes {
namespace {

Point3d towards(Angle azimuth, Angle elevation) {
  return {cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation)};
}

/// Spherical Fibonacci directions, by azimuths from true north.
std::vector<Point3d> fibonacci_hemisphere(std::size_t count) {
  std::vector<Point3d> directions;
  for (std::size_t n = 0; n < count; ++n) {
    const double up = (static_cast<double>(n) + 0.5) / static_cast<double>(count), level = std::sqrt(1.0 - up * up);
    const double turn = 2.0 * std::numbers::pi * std::fmod(static_cast<double>(n) * (2.0 - std::numbers::phi), 1.0);
    directions.push_back({level * std::sin(turn), level * std::cos(turn), up});
  }
  return directions;
}

/// A place on the sun's disk, another one for each number.
Point3d on_disk(const SunPosition& sun, std::size_t number) {
  constexpr double radius_deg = 0.2666;
  const double n = static_cast<double>(number);
  const double from_middle_deg = radius_deg * std::sqrt(std::fmod(n * 0.7548776662466927 + 0.5, 1.0)),
               turn = 2.0 * std::numbers::pi * std::fmod(n * 0.5698402909980532 + 0.5, 1.0);
  const Angle up = Angle::degrees(from_middle_deg * std::sin(turn)),
              aside = Angle::degrees(from_middle_deg * std::cos(turn) / std::max(0.01, cos(sun.elevation)));
  return towards(sun.azimuth + aside, sun.elevation + up);
}

Point3d turned_back(const Point3d& d, Angle convergence) {
  return {d.x * cos(convergence) - d.y * sin(convergence), d.x * sin(convergence) + d.y * cos(convergence), d.z};
}

}  // namespace

LightByRays::LightByRays(const Light& light, std::size_t directions, const GridRotation& rotation, Angle convergence) {
  add_sky(light, directions, rotation, convergence);
  add_sun(light, rotation, convergence);
}

void LightByRays::add_sky(const Light& light, std::size_t directions, const GridRotation& rotation, Angle convergence) {
  const std::vector<Point3d> places = fibonacci_hemisphere(directions);
  for (const Point3d& d : places) rays_.push_back({rotation.grid_from_city(turned_back(d, convergence)), Months{}});
  std::vector<double> relative(directions);
  for (const LightInterval& interval : light.intervals) {
    if (!(interval.diffuse_w_m2 > 0.0)) continue;
    const std::optional<SunPosition> sun = mean_sun(interval);
    // Means are of all of the interval, of which the sun may be up in a part
    const double share = sun ? interval.hours / sun->hours : 1.0;
    const SkyIrradiances while_up{share * interval.diffuse_w_m2, share * interval.direct_normal_w_m2,
                                  interval.extraterrestrial_w_m2};
    const Angle zenith_distance = Angle::degrees(90.0) - (sun ? sun->elevation : Angle());
    const PerezSky sky(sky_state(zenith_distance, while_up));
    const bool is_uniform = !sun || light.sky_model == SkyModel::isotropic;
    const Point3d to_sun = sun ? towards(sun->azimuth, sun->elevation) : Point3d{};
    double on_level = 0.0;
    for (std::size_t n = 0; n < directions; ++n) {
      const Point3d& d = places[n];
      relative[n] = is_uniform ? 1.0
                               : sky.radiance(Angle::radians(std::acos(d.z)),
                                              Angle::radians(std::acos(std::clamp(dot(d, to_sun), -1.0, 1.0))));
      on_level += relative[n] * d.z;
    }
    const double scale = energy_kwh_m2(interval.diffuse_w_m2, interval.hours) / on_level;
    for (std::size_t n = 0; n < directions; ++n) rays_[n].of_month[interval.month - 1] += scale * relative[n];
  }
}

void LightByRays::add_sun(const Light& light, const GridRotation& rotation, Angle convergence) {
  for (const LightInterval& interval : light.intervals) {
    const double energy = energy_kwh_m2(interval.direct_normal_w_m2, interval.hours);
    double hours = 0.0;
    for (const SunPosition& sun : interval.sun) hours += sun.hours;
    for (const SunPosition& sun : interval.sun) {
      const Point3d to_sun = on_disk(sun, rays_.size());
      Ray ray{rotation.grid_from_city(turned_back(to_sun, convergence)), Months{}};
      ray.of_month[interval.month - 1] = energy * sun.hours / hours;
      if (energy > 0.0) rays_.push_back(ray);
    }
  }
}

LightByRays::Months LightByRays::on(const Point3f& origin, const Point3d& normal, const Occluder& city,
                                    const CrownOccluder* crowns) const {
  constexpr float begin = 1e-3F;
  Months months{};
  for (const Ray& ray : rays_) {
    const Point3d& d = ray.direction_grid;
    const double cosine = dot(d, normal);
    if (cosine <= 0.0) continue;
    const farlod::Ray to_sky{origin, {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, begin};
    if (city.blocks(to_sky)) continue;
    const double passes = crowns == nullptr ? 1.0 : crowns->light(to_sky, CrownQuestion::light).transmitted;
    for (std::size_t m = 0; m < months.size(); ++m) months[m] += passes * cosine * ray.of_month[m];
  }
  return months;
}

double year_of(const LightByRays::Months& months) { return std::accumulate(months.begin(), months.end(), 0.0); }

}  // namespace farlod::scenes
