// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/sky_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace farlod {
namespace {

using std::numbers::pi;

/// The indicatrix of a sky, by half the chord from the sun to a place of the sky, sin(γ/2): to take it from a table is five times
/// as fast as its exponential and an arc cosine, and the cusp at the sun lies on a knot.
class IndicatrixTable {
 public:
  static constexpr std::size_t parts = 256;
  explicit IndicatrixTable(const PerezSky& sky) {
    static const std::array<SunDistance, parts + 1> distances = distances_of_knots();
    for (std::size_t n = 0; n <= parts; ++n) knots_[n].value = static_cast<float>(sky.indicatrix(distances[n]));
    for (std::size_t n = 0; n < parts; ++n) knots_[n].rise = knots_[n + 1].value - knots_[n].value;
  }
  /// At a place from 0 to `parts`, which is half the chord times `parts`.
  [[nodiscard]] float at(float place) const {
    const auto n = static_cast<std::int32_t>(place);
    const Knot& knot = knots_[static_cast<std::size_t>(n)];
    return knot.value + (place - static_cast<float>(n)) * knot.rise;
  }

 private:
  struct Knot {
    float value = 0.0F, rise = 0.0F;  ///< to the next one; none from the last
  };
  static std::array<SunDistance, parts + 1> distances_of_knots() {
    std::array<SunDistance, parts + 1> distances;
    for (std::size_t n = 0; n <= parts; ++n)
      distances[n] = SunDistance(Angle::radians(2.0 * std::asin(static_cast<double>(n) / static_cast<double>(parts))));
    return distances;
  }
  std::array<Knot, parts + 1> knots_{};
};

}  // namespace

std::optional<SunPosition> mean_sun(const LightInterval& interval) {
  double x = 0.0, y = 0.0, z = 0.0, hours = 0.0;
  for (const SunPosition& sun : interval.sun) {
    if (sun.elevation.radians() <= 0.0) continue;
    x += sun.hours * cos(sun.elevation) * sin(sun.azimuth);
    y += sun.hours * cos(sun.elevation) * cos(sun.azimuth);
    z += sun.hours * sin(sun.elevation);
    hours += sun.hours;
  }
  if (hours <= 0.0) return std::nullopt;
  return SunPosition{Angle::radians(std::atan2(x, y)), Angle::radians(std::atan2(z, std::hypot(x, y))), hours};
}

SkyGrid::SkyGrid() : radiances_(azimuths * bands), relative_(azimuths * bands) {
  const double height = 0.5 * pi / static_cast<double>(bands);
  for (std::size_t n = 0; n < bands; ++n) {
    const double from = height * static_cast<double>(n), middle = from + 0.5 * height, to = from + height;
    const double weight = pi / static_cast<double>(azimuths) * (std::pow(std::sin(to), 2) - std::pow(std::sin(from), 2));
    bands_.push_back({std::sin(middle), std::cos(middle), weight});
  }
  for (std::size_t k = 0; k < azimuths; ++k) {
    const double azimuth = 2.0 * pi * (static_cast<double>(k) + 0.5) / static_cast<double>(azimuths);
    cosines_.push_back(std::cos(azimuth));
    sines_.push_back(std::sin(azimuth));
  }
}

void SkyGrid::add(const LightInterval& interval, SkyModel model, double on_level) {
  if (!(on_level > 0.0) || !(interval.diffuse_w_m2 > 0.0)) return;
  on_level_ += on_level;
  const std::optional<SunPosition> sun = mean_sun(interval);
  if (!sun || model == SkyModel::isotropic) return add_uniform(on_level);
  // While the sun is up, there is the light of all of the interval
  const double share = interval.hours / std::min(interval.hours, sun->hours);
  const SkyState state =
      sky_state(Angle::degrees(90.0) - sun->elevation,
                {share * interval.diffuse_w_m2, share * interval.direct_normal_w_m2, interval.extraterrestrial_w_m2});
  add_perez(state, sun->azimuth, on_level);
}

void SkyGrid::add(const SkyGrid& other) {
  on_level_ += other.on_level_;
  uniform_ += other.uniform_;
  for (std::size_t n = 0; n < radiances_.size(); ++n) radiances_[n] += other.radiances_[n];
}

void SkyGrid::add_perez(const SkyState& state, Angle sun_azimuth, double energy) {
  const PerezSky sky(state);
  const IndicatrixTable indicatrix(sky);
  const double sun_up = cos(state.sun_zenith), sun_level = sin(state.sun_zenith);
  const double east = sun_level * sin(sun_azimuth), north = sun_level * cos(sun_azimuth);
  std::array<float, azimuths> level{}, places{};
  for (std::size_t k = 0; k < azimuths; ++k) level[k] = static_cast<float>(north * cosines_[k] + east * sines_[k]);
  double all = 0.0;
  for (std::size_t n = 0; n < bands; ++n) {
    const Band& band = bands_[n];
    const double gradation = sky.gradation(band.sine);
    // Half the chord of an angle γ is √(½ − ½ cos γ). Roots alone, so that the compiler takes several at once
    const auto up = static_cast<float>(band.sine * sun_up), cosine = static_cast<float>(band.cosine);
    for (std::size_t k = 0; k < azimuths; ++k) {
      const float square = 0.5F - 0.5F * (up + cosine * level[k]);
      places[k] = static_cast<float>(IndicatrixTable::parts) * std::sqrt(square > 0.0F ? std::min(square, 1.0F) : 0.0F);
    }
    double of_band = 0.0;
    for (std::size_t k = 0; k < azimuths; ++k) {
      const double radiance = std::max(0.0, gradation * static_cast<double>(indicatrix.at(places[k])));
      relative_[n * azimuths + k] = radiance;
      of_band += radiance;
    }
    all += of_band * band.weight;
  }
  if (!(all > 0.0)) return add_uniform(energy);
  for (std::size_t n = 0; n < relative_.size(); ++n) radiances_[n] += energy / all * relative_[n];
}

double SkyGrid::radiance(double turn, Angle elevation) const {
  const double height = elevation.radians() / (0.5 * pi) * static_cast<double>(bands) - 0.5;
  const double place = std::clamp(height, 0.0, static_cast<double>(bands - 1));
  const std::size_t band = std::min(static_cast<std::size_t>(place), bands - 2);
  const double up = place - static_cast<double>(band);
  const double round = (turn - std::floor(turn)) * static_cast<double>(azimuths) + static_cast<double>(azimuths) - 0.5;
  const std::size_t from = static_cast<std::size_t>(round) % azimuths, to = (from + 1) % azimuths;
  const double on = round - std::floor(round);
  const auto of_band = [&](std::size_t n) {
    return radiances_[n * azimuths + from] + on * (radiances_[n * azimuths + to] - radiances_[n * azimuths + from]);
  };
  return uniform_ / pi + of_band(band) + up * (of_band(band + 1) - of_band(band));
}

}  // namespace farlod
