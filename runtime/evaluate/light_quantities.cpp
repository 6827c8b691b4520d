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
#include "horizon/kernels.hpp"
#include "horizon/light_kernels.hpp"
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

/// What crowns take of the light of a packet.
class LightOfCrowns {
 public:
  /// lost[receiver][pair]
  using Sums = std::array<std::array<LightPair, LightTable::most_pairs>, packet_lanes>;

  LightOfCrowns(const LightTable& light, const AzimuthSampling& azimuths, const ProfiledPacket& packet)
      : light_(light), azimuths_(azimuths), packet_(packet) {}

  /// Adds what they take between two slopes.
  void add_lost(const DimmedSlopes& dimmed, Sums& lost) {
    const SkyProfile& profile = packet_.profile;
    azimuth_ = dimmed.azimuth;
    const std::size_t l = dimmed.lane;
    normal_ = normal_parts(packet_.receivers, l, azimuths_, azimuth_);
    front_ = slopes_in_front_of(normal_.outward, normal_.upward);
    const float from = profile.sky_from[azimuth_][l];
    // Where the horizon jumps, they take so much of what is left above it
    const float seen = profile.light_sky.empty() ? 1.0F : share_above(l, from);
    add_between(std::max(dimmed.low, from), dimmed.high, dimmed.lost * seen, lost[l]);
    if (profile.gap_share.empty() || !(profile.gap_share[azimuth_][l] > 0.0F)) return;
    add_between(std::max(dimmed.low, profile.gap_from[azimuth_][l]), std::min(dimmed.high, profile.gap_to[azimuth_][l]),
                dimmed.lost * profile.gap_share[azimuth_][l], lost[l]);
  }

 private:
  /// Adds a share of what comes from between two slopes, in front of the receiver.
  void add_between(float from, float to, float share, Sums::value_type& sums) const {
    from = std::max(from, front_.from);
    to = std::min(to, front_.to);
    if (!(from < std::min(to, no_light_above))) return;
    const float outward = share * normal_.outward, upward = share * normal_.upward;
    light_.add_above(azimuth_, LightTable::place_of(from), outward, upward, sums.data());
    if (to < no_light_above) light_.add_above(azimuth_, LightTable::place_of(to), -outward, -upward, sums.data());
  }
  /// The sky that the profile knows, as a share of that above the slope of the horizon.
  [[nodiscard]] float share_above(std::size_t lane, float horizon) const {
    Sums::value_type above{};
    add_between(horizon, zenith_slope, static_cast<float>(azimuths_.size()), above);
    const float uniform = light_of_layer(above.data(), static_cast<std::size_t>(LightLayer::uniform));
    return uniform > 0.0F ? packet_.profile.light_sky[azimuth_][lane] / uniform : 0.0F;
  }

  const LightTable& light_;
  const AzimuthSampling& azimuths_;
  const ProfiledPacket& packet_;
  std::size_t azimuth_ = 0;
  NormalParts normal_{0.0F, 1.0F};
  SlopesInFront front_;
};

/// The sky of the profile, `seen` of the uniform sky, lacks what `svf` knows better, such as where horizons jump between
/// azimuths. A sky that is hardly seen tells nothing of the other: that counts as the mean of all the sky.
float with_the_sky_of(float svf, float seen, float from_profile, float on_level) {
  constexpr float least_seen = 0.02F;
  const float of_missing = seen > least_seen ? from_profile / seen : on_level;
  return std::max(0.0F, from_profile + (svf - seen) * of_missing);
}

/// Rounding may leave less than nothing.
void add_hours(const std::array<double, packet_lanes>& hours, QuantityColumns& columns) {
  Lanes column;
  std::transform(hours.begin(), hours.end(), column.begin(), [](double h) { return static_cast<float>(std::max(h, 0.0)); });
  columns.add(column);
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

FurtherQuantities::SunOfTime FurtherQuantities::sun_of(std::span<const LightInterval> intervals) const {
  SunOfTime time;
  std::vector<SunPosition> sun;
  for (const LightInterval& interval : intervals)
    for (const SunPosition& position : interval.sun) {
      if (position.elevation.radians() <= 0.0) continue;
      sun.push_back(position);
      time.hours += position.hours;
    }
  time.at_azimuths = sorted_by_azimuth(sun);
  return time;
}

void FurtherQuantities::sort_sun_of_light() {
  const std::vector<LightInterval> none, &intervals = quantities_.light ? quantities_.light->intervals : none;
  sun_of_light_ = sun_of(intervals);
  if (!quantities_.light || !quantities_.light->by_step) return;
  for (const LightInterval& interval : intervals)
    if (has_sun(interval)) sun_of_steps_.push_back(sun_of({&interval, 1}));
}

double FurtherQuantities::SunAtAzimuth::hours_between(float from, float to) const {
  const auto hours_above = [this](float slope) {
    const auto first = std::upper_bound(slopes.begin(), slopes.end(), slope) - slopes.begin();
    return hours[static_cast<std::size_t>(first)];
  };
  return from < to ? hours_above(from) - hours_above(to) : 0.0;
}

double FurtherQuantities::hours_between(float from, float to, const SunAtAzimuth& sun, std::size_t azimuth,
                                        const ProfiledPacket& packet, std::size_t lane) const {
  const SkyProfile& profile = packet.profile;
  const NormalParts normal = normal_parts(packet.receivers, lane, azimuths_, azimuth);
  const SlopesInFront front = slopes_in_front_of(normal.outward, normal.upward);
  from = std::max(from, front.from);
  to = std::min(to, front.to);
  double hours = sun.hours_between(std::max(from, profile.sky_from[azimuth][lane]), to);
  if (!profile.gap_share.empty())
    hours += static_cast<double>(profile.gap_share[azimuth][lane]) *
             sun.hours_between(std::max(from, profile.gap_from[azimuth][lane]), std::min(to, profile.gap_to[azimuth][lane]));
  return hours;
}

std::array<double, packet_lanes> FurtherQuantities::hours_of(const std::vector<SunAtAzimuth>& sun,
                                                             const ProfiledPacket& packet) const {
  std::array<double, packet_lanes> hours{};
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    for (std::size_t l = 0; l < packet.receivers.count && !sun[k].slopes.empty(); ++l)
      hours[l] += hours_between(0.0F, zenith_slope, sun[k], k, packet, l);
  return hours;
}

void FurtherQuantities::add_sunlit(const ProfiledPacket& packet, QuantityColumns& columns) const {
  add_hours(hours_of(sun_, packet), columns);
}

void FurtherQuantities::add_sunlit_total(const ProfiledPacket& packet, QuantityColumns& columns) const {
  add_hours(hours_past_crowns(sun_, packet), columns);
}

std::array<double, packet_lanes> FurtherQuantities::hours_past_crowns(const std::vector<SunAtAzimuth>& sun,
                                                                      const ProfiledPacket& packet) const {
  std::array<double, packet_lanes> hours = hours_of(sun, packet);
  for (const DimmedSlopes& d : packet.dimmed)
    if (const SunAtAzimuth& at = sun[d.azimuth]; !at.slopes.empty())
      hours[d.lane] -= static_cast<double>(d.lost) * hours_between(d.low, d.high, at, d.azimuth, packet, d.lane);
  return hours;
}

FurtherQuantities::Lanes FurtherQuantities::shade_of(const SunOfTime& time, const ProfiledPacket& packet) const {
  const std::array<double, packet_lanes> hours = hours_past_crowns(time.at_azimuths, packet);
  Lanes shade;
  for (std::size_t l = 0; l < packet_lanes; ++l)
    shade[l] = time.hours > 0.0 ? static_cast<float>(std::clamp(1.0 - hours[l] / time.hours, 0.0, 1.0))
                                : std::numeric_limits<float>::quiet_NaN();
  return shade;
}

void FurtherQuantities::add_shade(const ProfiledPacket& packet, QuantityColumns& columns) const {
  columns.add(shade_of(sun_of_light_, packet));
  for (const SunOfTime& step : sun_of_steps_) columns.add(shade_of(step, packet));
}

void FurtherQuantities::find_light(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                                   std::vector<PacketHorizon::Row>& light) const {
  FARLOD_EXPECTS(profiles.size() == packets.size());
  const std::size_t layers = light_layers();
  light.resize(packets.size() * layers);
  if (light.empty()) return;
  const auto rows = [](const SkyProfile::Rows& r) { return r.empty() ? nullptr : r.front().data(); };
  std::vector<LitPacket> lit;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const SkyProfile& profile = profiles[n];
    lit.push_back({.receivers = &packets[n],
                   .all_look_up = packets[n].all_look_straight_up(),
                   .sky_from = rows(profile.sky_from),
                   .gap_from = rows(profile.gap_from),
                   .gap_to = rows(profile.gap_to),
                   .gap_share = rows(profile.gap_share),
                   .sky = rows(profile.light_sky),
                   .sums = light[n * layers].data()});
  }
  light_kernels().sum_light({.even = light_->even(),
                             .pairs = light_->pairs(),
                             .pair_count = static_cast<std::uint32_t>(light_->pair_count()),
                             .wants_even = quantities_.sky_component,
                             .azimuths = azimuths_.view()},
                            lit);
}

void FurtherQuantities::find_lost_light(const ProfiledPacket& packet) const {
  LightOfCrowns::Sums lost{};
  LightOfCrowns crowns(*light_, azimuths_, packet);
  for (const DimmedSlopes& dimmed : packet.dimmed) crowns.add_lost(dimmed, lost);
  packet.rows.lost.resize(light_->layers());
  for (std::size_t n = 0; n < light_->layers(); ++n)
    for (std::size_t l = 0; l < packet_lanes; ++l) packet.rows.lost[n][l] = light_of_layer(lost[l].data(), n);
}

FurtherQuantities::Lanes FurtherQuantities::LightParts::sum() const {
  Lanes sum;
  for (std::size_t l = 0; l < packet_lanes; ++l) sum[l] = direct[l] + diffuse[l] + reflected[l];
  return sum;
}

FurtherQuantities::LightParts FurtherQuantities::light_parts(const ProfiledPacket& packet) const {
  constexpr auto direct = static_cast<std::size_t>(LightLayer::direct), diffuse = static_cast<std::size_t>(LightLayer::diffuse),
                 uniform = static_cast<std::size_t>(LightLayer::uniform);
  const float on_level = light_->on_level()[diffuse];
  const std::span<const PacketHorizon::Row> sums = packet.light, lost = packet.rows.lost;
  LightParts parts{};
  for (std::size_t l = 0; l < packet.receivers.count; ++l) {
    const float diffuse_sky = with_the_sky_of(packet.sky.svf[l], sums[uniform][l], sums[diffuse][l], on_level);
    parts.beside_profile[l] = on_level > 0.0F ? (diffuse_sky - sums[diffuse][l]) / on_level : 0.0F;
    parts.direct[l] = std::max(0.0F, sums[direct][l] - lost[direct][l]);
    parts.diffuse[l] = std::max(0.0F, diffuse_sky - lost[diffuse][l]);
    parts.reflected[l] = reflected(packet, l, direct) + reflected(packet, l, diffuse);
  }
  return parts;
}

float FurtherQuantities::reflected(const ProfiledPacket& packet, std::size_t lane, std::size_t layer) const {
  const auto ground = static_cast<float>(quantities_.light ? quantities_.light->ground_albedo : 0.0),
             facade = static_cast<float>(quantities_.light ? quantities_.light->facade_albedo : 0.0);
  const float svf = packet.sky.svf[lane], up = packet.receivers.normal_z[lane];
  const float below = 0.5F * (1.0F - up), hidden = std::max(0.0F, 0.5F * (1.0F + up) - svf);
  return ground * below * light_->on_level()[layer] + facade * hidden * light_->on_upright()[layer];
}

FurtherQuantities::Lanes FurtherQuantities::total_light(const ProfiledPacket& packet, const LightParts& parts,
                                                        std::size_t total) const {
  const std::size_t layer = static_cast<std::size_t>(LightLayer::first_total) + total;
  Lanes column{};
  for (std::size_t l = 0; l < packet.receivers.count; ++l) {
    const float beside_profile = parts.beside_profile[l] * light_->diffuse_of_totals()[total];
    column[l] =
        std::max(0.0F, packet.light[layer][l] + beside_profile - packet.rows.lost[layer][l]) + reflected(packet, l, layer);
  }
  return column;
}

void FurtherQuantities::add_irradiation(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const LightParts parts = light_parts(packet);
  columns.add(parts.sum());
  columns.add(parts.direct);
  columns.add(parts.diffuse);
  columns.add(parts.reflected);
  for (std::size_t n = 0; n < light_->months().size(); ++n) columns.add(total_light(packet, parts, n));
}

void FurtherQuantities::add_irradiance(const ProfiledPacket& packet, QuantityColumns& columns) const {
  constexpr double watts_in_kilowatt = 1000.0;
  const double mean = light_->hours() > 0.0 ? watts_in_kilowatt / light_->hours() : 0.0;
  Lanes column = light_parts(packet).sum();
  for (float& irradiance : column) irradiance = static_cast<float>(mean * static_cast<double>(irradiance));
  columns.add(column);
}

void FurtherQuantities::add_illuminance(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const double hours = light_->hours_of_illuminance();
  Lanes column = total_light(packet, light_parts(packet), light_->months().size());
  for (float& light : column) light = hours > 0.0 ? static_cast<float>(static_cast<double>(light) / hours) : 0.0F;
  columns.add(column);
}

void FurtherQuantities::add_sky_component(const ProfiledPacket& packet, QuantityColumns& columns) const {
  constexpr auto overcast = static_cast<std::size_t>(LightLayer::overcast),
                 uniform = static_cast<std::size_t>(LightLayer::uniform);
  const std::span<const PacketHorizon::Row> sums = packet.light;
  Lanes column{};
  for (std::size_t l = 0; l < packet.receivers.count; ++l) {
    const float sky = with_the_sky_of(packet.sky.svf[l], sums[uniform][l], sums[overcast][l], light_->on_level()[overcast]);
    column[l] = std::max(0.0F, sky - packet.rows.lost[overcast][l]);
  }
  columns.add(column);
}

}  // namespace farlod
