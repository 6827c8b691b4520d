// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/expects.hpp"
#include "evaluate/further_quantities.hpp"
#include "receivers/receiver.hpp"

// What is made of the sun and of the sky's light.

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// Above it is nothing that counts, and it is finite.
constexpr float zenith_slope = 1e7F;

/// The slopes at an azimuth at which light falls on a receiver's front: o + w t > 0.
struct SlopesInFront {
  float from = 0.0F, to = zenith_slope;
};
SlopesInFront slopes_in_front_of(float outward, float upward) {
  if (outward > 0.0F) return {0.0F, upward < 0.0F ? std::min(zenith_slope, -outward / upward) : zenith_slope};
  return upward > 0.0F ? SlopesInFront{-outward / upward, zenith_slope} : SlopesInFront{zenith_slope, zenith_slope};
}

/// The parts of a receiver's normal along an azimuth, and up.
struct NormalParts {
  float outward, upward;
};
NormalParts normal_parts(const ReceiverPacket& receivers, std::size_t lane, const AzimuthSampling& azimuths,
                         std::size_t azimuth) {
  return {receivers.normal_x[lane] * azimuths.cosine()[azimuth] + receivers.normal_y[lane] * azimuths.sine()[azimuth],
          receivers.normal_z[lane]};
}

/// Above a slope of so much there is next to no light.
constexpr float as_good_as_zenith = 1e5F;

/// What the receivers of a packet get from an azimuth.
class LightOfColumn {
 public:
  LightOfColumn(const LightTable& light, const AzimuthSampling& azimuths, const ProfiledPacket& packet)
      : light_(light),
        azimuths_(azimuths),
        packet_(packet),
        all_look_up_(packet.receivers.all_look_straight_up()),
        of_turn_(1.0F / static_cast<float>(azimuths.size())) {}

  /// Adds to sums[receiver][layer].
  void add_to(std::size_t azimuth, float* sums) {
    const SkyProfile& profile = packet_.profile;
    azimuth_ = azimuth;
    for (std::size_t l = 0; l < packet_.receivers.count; ++l, sums += light_.layers()) {
      face(l);
      read(profile.sky_from[azimuth][l], zenith_slope, here_.data());
      if (!profile.sky.empty()) move_jump(l);
      for (std::size_t n = 0; n < light_.layers(); ++n) sums[n] += here_[n];
      if (!profile.gap_share.empty() && profile.gap_share[azimuth][l] > 0.0F) add_gap(l, sums);
    }
  }

 private:
  void face(std::size_t lane) {
    if (all_look_up_) return;
    normal_ = normal_parts(packet_.receivers, lane, azimuths_, azimuth_);
    front_ = slopes_in_front_of(normal_.outward, normal_.upward);
  }
  /// What comes from between two slopes, in front of the receiver.
  void read(float from, float to, float* layers) {
    from = std::max(from, front_.from);
    to = std::min(to, front_.to);
    if (!(from < std::min(to, as_good_as_zenith))) {
      std::fill_n(layers, light_.layers(), 0.0F);
      return;
    }
    light_.read_above(azimuth_, LightTable::place_of(from), normal_.outward, normal_.upward, layers);
    if (to >= as_good_as_zenith) return;
    light_.read_above(azimuth_, LightTable::place_of(to), normal_.outward, normal_.upward, above_.data());
    for (std::size_t n = 0; n < light_.layers(); ++n) layers[n] -= above_[n];
  }
  void add_gap(std::size_t lane, float* sums) {
    const SkyProfile& profile = packet_.profile;
    read(profile.gap_from[azimuth_][lane], profile.gap_to[azimuth_][lane], here_.data());
    for (std::size_t n = 0; n < light_.layers(); ++n) sums[n] += profile.gap_share[azimuth_][lane] * here_[n];
  }
  /// Where the horizon jumps between two azimuths, the sky of the profile knows at which place: so much of this azimuth's part of
  /// the turn has the horizon of its neighbor.
  void move_jump(std::size_t lane) {
    constexpr float least = 2e-3F;
    constexpr auto uniform = static_cast<std::size_t>(LightLayer::uniform);
    const float missing = packet_.profile.sky[azimuth_][lane] * of_turn_ - here_[uniform];
    if (std::abs(missing) < least * of_turn_) return;
    const SkyProfile::Rows& slopes = packet_.profile.sky_from;
    const float before = slopes[azimuth_ == 0 ? azimuths_.size() - 1 : azimuth_ - 1][lane],
                after = slopes[azimuth_ + 1 == azimuths_.size() ? 0 : azimuth_ + 1][lane];
    // The lower of both horizons where sky is missing, otherwise the higher one
    read(missing > 0.0F ? std::min(before, after) : std::max(before, after), zenith_slope, beside_.data());
    const float whole = beside_[uniform] - here_[uniform];
    if (!(whole * missing > 0.0F)) return;
    const float share = std::min(1.0F, missing / whole);
    for (std::size_t n = 0; n < light_.layers(); ++n) here_[n] += share * (beside_[n] - here_[n]);
  }

  const LightTable& light_;
  const AzimuthSampling& azimuths_;
  const ProfiledPacket& packet_;
  bool all_look_up_;
  float of_turn_;  ///< the share of an azimuth
  std::size_t azimuth_ = 0;
  NormalParts normal_{0.0F, 1.0F};
  SlopesInFront front_;
  std::array<float, LightTable::most_layers> here_{}, beside_{}, above_{};
};

/// The sky of the profile, `seen` of the uniform sky, lacks what `svf` knows better, such as where horizons jump between
/// azimuths. A sky that is hardly seen tells nothing of the other: that counts as the mean of all the sky.
float with_the_sky_of(float svf, float seen, float from_profile, float on_level) {
  constexpr float least_seen = 0.02F;
  const float of_missing = seen > least_seen ? from_profile / seen : on_level;
  return std::max(0.0F, from_profile + (svf - seen) * of_missing);
}

}  // namespace

std::size_t FurtherQuantities::nearest_azimuth(Angle azimuth) const {
  const double turn = azimuth.radians() / (2.0 * std::numbers::pi);
  const auto distance = [&](double other) {
    const double between = turn - other;
    return std::abs(between - std::round(between));
  };
  const auto nearest =
      std::min_element(turns_.begin(), turns_.end(), [&](double a, double b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - turns_.begin());
}

std::vector<FurtherQuantities::SunAtAzimuth> FurtherQuantities::sorted_by_azimuth(std::span<const SunPosition> sun) const {
  using Position = std::pair<float, double>;  // slope, hours
  std::vector<std::vector<Position>> at(azimuths_.size());
  for (const SunPosition& position : sun) {
    if (position.elevation.radians() <= 0.0) continue;
    const double slope = std::min(tan(position.elevation), static_cast<double>(zenith_slope));
    at[nearest_azimuth(position.azimuth)].emplace_back(static_cast<float>(slope), position.hours);
  }
  std::vector<SunAtAzimuth> sorted;
  for (std::vector<Position>& positions : at) {
    std::sort(positions.begin(), positions.end());
    SunAtAzimuth& of_azimuth = sorted.emplace_back();
    for (const auto& [slope, hours] : positions) {
      of_azimuth.slopes.push_back(slope);
      of_azimuth.hours.push_back(hours);
    }
    for (std::size_t n = of_azimuth.hours.size(); n-- > 1;) of_azimuth.hours[n - 1] += of_azimuth.hours[n];
    of_azimuth.hours.push_back(0.0);
  }
  return sorted;
}

void FurtherQuantities::sort_sun_of_light() {
  std::vector<SunPosition> sun;
  for (const LightInterval& interval : quantities_.light.value_or(Light{}).intervals)
    for (const SunPosition& position : interval.sun) {
      if (position.elevation.radians() <= 0.0) continue;
      sun.push_back(position);
      hours_of_light_ += position.hours;
    }
  sun_of_light_ = sorted_by_azimuth(sun);
}

std::array<double, packet_lanes> FurtherQuantities::hours_of(const std::vector<SunAtAzimuth>& sun_at_azimuths,
                                                             const ProfiledPacket& packet) const {
  const auto& [profile, receivers, sky, rows] = packet;
  std::array<double, packet_lanes> hours{};
  for (std::size_t k = 0; k < azimuths_.size(); ++k) {
    const SunAtAzimuth& sun = sun_at_azimuths[k];
    if (sun.slopes.empty()) continue;
    const auto hours_above = [&](float slope) {
      const auto first = std::upper_bound(sun.slopes.begin(), sun.slopes.end(), slope) - sun.slopes.begin();
      return sun.hours[static_cast<std::size_t>(first)];
    };
    const auto hours_between = [&](float from, float to) { return from < to ? hours_above(from) - hours_above(to) : 0.0; };
    for (std::size_t l = 0; l < receivers.count; ++l) {
      const NormalParts normal = normal_parts(receivers, l, azimuths_, k);
      const SlopesInFront front = slopes_in_front_of(normal.outward, normal.upward);
      hours[l] += hours_between(std::max(profile.sky_from[k][l], front.from), front.to);
      if (profile.gap_share.empty()) continue;
      hours[l] += static_cast<double>(profile.gap_share[k][l]) *
                  hours_between(std::max(profile.gap_from[k][l], front.from), std::min(profile.gap_to[k][l], front.to));
    }
  }
  return hours;
}

void FurtherQuantities::add_sunlit(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const std::array<double, packet_lanes> hours = hours_of(sun_, packet);
  Lanes column;
  std::transform(hours.begin(), hours.end(), column.begin(), [](double h) { return static_cast<float>(h); });
  columns.add(column);
}

void FurtherQuantities::add_shade(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const std::array<double, packet_lanes> hours = hours_of(sun_of_light_, packet);
  Lanes column;
  for (std::size_t l = 0; l < packet_lanes; ++l)
    column[l] = hours_of_light_ > 0.0 ? static_cast<float>(std::clamp(1.0 - hours[l] / hours_of_light_, 0.0, 1.0))
                                      : std::numeric_limits<float>::quiet_NaN();
  columns.add(column);
}

void FurtherQuantities::find_light(const ProfiledPacket& packet) const {
  packet.rows.light.assign(packet_lanes * light_->layers(), 0.0F);
  LightOfColumn column(*light_, azimuths_, packet);
  for (std::size_t k = 0; k < azimuths_.size(); ++k) column.add_to(k, packet.rows.light.data());
}

FurtherQuantities::LightParts FurtherQuantities::light_parts(const ProfiledPacket& packet, std::size_t direct) const {
  const std::size_t layers = light_->layers(), diffuse = direct + 1;
  const auto level = light_->on_level(), upright = light_->on_upright();
  const auto ground = static_cast<float>(quantities_.light ? quantities_.light->ground_albedo : 0.0),
             facade = static_cast<float>(quantities_.light ? quantities_.light->facade_albedo : 0.0);
  LightParts parts{};
  for (std::size_t l = 0; l < packet.receivers.count; ++l) {
    const float* const sums = &packet.rows.light[l * layers];
    const float svf = packet.sky.svf[l], up = packet.receivers.normal_z[l];
    parts.direct[l] = std::max(0.0F, sums[direct]);
    parts.diffuse[l] = with_the_sky_of(svf, sums[static_cast<std::size_t>(LightLayer::uniform)], sums[diffuse], level[diffuse]);
    const float below = 0.5F * (1.0F - up), hidden = std::max(0.0F, 0.5F * (1.0F + up) - svf);
    parts.reflected[l] =
        ground * below * (level[direct] + level[diffuse]) + facade * hidden * (upright[direct] + upright[diffuse]);
  }
  return parts;
}

void FurtherQuantities::add_irradiation(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const auto sum_of = [](const LightParts& parts) {
    Lanes sum;
    for (std::size_t l = 0; l < packet_lanes; ++l) sum[l] = parts.direct[l] + parts.diffuse[l] + parts.reflected[l];
    return sum;
  };
  const LightParts parts = light_parts(packet, static_cast<std::size_t>(LightLayer::direct));
  columns.add(sum_of(parts));
  columns.add(parts.direct);
  columns.add(parts.diffuse);
  columns.add(parts.reflected);
  for (std::size_t n = 0; n < light_->months().size(); ++n)
    columns.add(sum_of(light_parts(packet, static_cast<std::size_t>(LightLayer::first_month) + 2 * n)));
}

void FurtherQuantities::add_irradiance(const ProfiledPacket& packet, QuantityColumns& columns) const {
  constexpr double watts_in_kilowatt = 1000.0;
  const LightParts parts = light_parts(packet, static_cast<std::size_t>(LightLayer::direct));
  const double mean = light_->hours() > 0.0 ? watts_in_kilowatt / light_->hours() : 0.0;
  Lanes column;
  for (std::size_t l = 0; l < packet_lanes; ++l)
    column[l] = static_cast<float>(mean * static_cast<double>(parts.direct[l] + parts.diffuse[l] + parts.reflected[l]));
  columns.add(column);
}

void FurtherQuantities::add_sky_component(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const std::size_t layers = light_->layers();
  Lanes column{};
  for (std::size_t l = 0; l < packet.receivers.count; ++l) {
    const float* const sums = &packet.rows.light[l * layers];
    column[l] = with_the_sky_of(packet.sky.svf[l], sums[static_cast<std::size_t>(LightLayer::uniform)],
                                sums[static_cast<std::size_t>(LightLayer::overcast)], 1.0F);
  }
  columns.add(column);
}

}  // namespace farlod
