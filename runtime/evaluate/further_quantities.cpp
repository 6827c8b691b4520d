// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/further_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "base/expects.hpp"
#include "farlod/angle.hpp"
#include "horizon/kernels.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

/// How far below the horizon a ray looks. The first is more than a horizon of rays is off; the others are for far maps, whose
/// horizon may lie above the true one.
constexpr double degrees_below[] = {0.02, 0.1, 0.5, 2.0};

/// The length of a direction's level part is 1: so distances along it are level ones.
float distance_below(const Occluder& city, const Point3f& origin, const Point2d& direction, double elevation_deg) {
  for (const double below_deg : degrees_below) {
    const double slope = tan(Angle::degrees(std::max(0.0, elevation_deg - below_deg)));
    const Point3f towards{static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(slope)};
    if (const auto hit = city.nearest({origin, towards, least_distance_m})) return hit->distance;
  }
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

void trace_horizon_distances(const Occluder& city, const Point3f& origin, const HorizonColumns& columns,
                             std::span<float> values) {
  for (std::size_t n = 0; n < columns.directions_grid.size(); ++n) {
    const double elevation_deg = static_cast<double>(values[columns.elevations + n]);
    values[columns.distances + n] = elevation_deg > 0.0 ? distance_below(city, origin, columns.directions_grid[n], elevation_deg)
                                                        : std::numeric_limits<float>::quiet_NaN();
  }
}

namespace {

using Row = PacketHorizon::Row;
using Lanes = PacketHorizon::Lanes;

/// Above it is nothing that counts, and it is finite.
constexpr float straight_up = 1e7F;

std::vector<Point3d> directions_clockwise_from_north(std::size_t count, const package::Manifest& manifest) {
  std::vector<Point3d> directions;
  for (std::size_t n = 0; n < count; ++n) {
    const double turn = static_cast<double>(n) / static_cast<double>(count);
    // true azimuth = grid azimuth + convergence
    const Angle azimuth = Angle::radians(2.0 * std::numbers::pi * turn) - manifest.convergence;
    directions.push_back(manifest.grid.rotation.grid_from_city(Point3d{sin(azimuth), cos(azimuth), 0.0}));
  }
  return directions;
}

AzimuthSampling sampling_for(const Quantities& quantities, std::size_t azimuths, const package::Manifest& manifest) {
  if (quantities.horizons == 0) return AzimuthSampling::even(azimuths, manifest.grid.rotation);
  return AzimuthSampling(directions_clockwise_from_north(azimuths, manifest));
}

std::vector<double> turns_of(const AzimuthSampling& azimuths, const package::Manifest& manifest) {
  std::vector<double> turns;
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    turns.push_back(turn_of(Point2d{azimuths.cosine()[k], azimuths.sine()[k]}, manifest.grid.rotation, manifest.convergence));
  return turns;
}

Lanes sum(const std::vector<Row>& rows) {
  std::array<double, packet_lanes> sums{};
  for (const Row& row : rows)
    for (std::size_t l = 0; l < packet_lanes; ++l) sums[l] += static_cast<double>(row[l]);
  Lanes result;
  std::transform(sums.begin(), sums.end(), result.begin(), [](double s) { return static_cast<float>(s); });
  return result;
}

/// terms = shares of the turn's sky between `low` and `high`.
void find_sky_between(const std::vector<Row>& low, const std::vector<Row>& high, const ReceiverPacket& receivers,
                      const AzimuthSampling& azimuths, bool is_solid, std::vector<Row>& terms) {
  terms.resize(azimuths.size());
  sky_kernels().find_sky_between(low.front().data(), high.front().data(), receivers, azimuths.view(), is_solid,
                                 terms.front().data());
}

void clamp_rows(const std::vector<Row>& rows, float low, float high, std::vector<Row>& clamped) {
  clamped.resize(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t l = 0; l < packet_lanes; ++l) clamped[k][l] = std::clamp(rows[k][l], low, high);
}

void fill_rows(std::size_t count, float value, std::vector<Row>& rows) {
  Row row;
  row.fill(value);
  rows.assign(count, row);
}

/// Adds the sky that is seen in gaps, between two slopes, to `terms`, by the cosine or by solid angle.
void add_sky_in_gaps(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths, float from,
                     float to, bool is_solid, ProfiledPacket::Rows& rows) {
  if (profile.gap_share.empty()) return;
  clamp_rows(profile.gap_from, from, to, rows.low);
  clamp_rows(profile.gap_to, from, to, rows.high);
  find_sky_between(rows.low, rows.high, receivers, azimuths, is_solid, rows.open_terms);
  for (std::size_t k = 0; k < rows.terms.size(); ++k)
    for (std::size_t l = 0; l < packet_lanes; ++l) rows.terms[k][l] += profile.gap_share[k][l] * rows.open_terms[k][l];
}

/// The shares of the turn of the sky above profiles, from rows of F(φ) where they are known.
void find_sky(const SkyProfile& profile, const SkyProfile::Rows& known, const ReceiverPacket& receivers,
              const AzimuthSampling& azimuths, bool is_solid, ProfiledPacket::Rows& rows) {
  if (known.empty()) {
    fill_rows(azimuths.size(), straight_up, rows.high);
    find_sky_between(profile.sky_from, rows.high, receivers, azimuths, is_solid, rows.terms);
  } else {
    rows.terms = known;
    const float share = 1.0F / static_cast<float>(azimuths.size());
    for (Row& row : rows.terms)
      for (float& sky : row) sky *= share;
  }
  add_sky_in_gaps(profile, receivers, azimuths, 0.0F, straight_up, is_solid, rows);
}

}  // namespace

std::size_t azimuths_for(const Quantities& quantities, std::size_t at_least) {
  if (quantities.horizons == 0) return at_least;
  return (at_least + quantities.horizons - 1) / quantities.horizons * quantities.horizons;
}

ViewRanges view_ranges_of(const Quantities& quantities) {
  return {.all = range_of(Quantity::view_factors, quantities),
          .below = range_of(Quantity::view_factors_below, quantities),
          .cube = range_of(Quantity::view_cube, quantities),
          .sphere = range_of(Quantity::view_sphere, quantities),
          .eye = range_of(Quantity::view_eye, quantities),
          .building = range_of(Quantity::view_building, quantities)};
}

FurtherQuantities::FurtherQuantities(const Quantities& quantities, std::size_t azimuths, const package::Manifest& manifest,
                                     std::shared_ptr<const LightOfPeriod> light)
    : quantities_(quantities),
      size_(columns_of(quantities).size()),
      crowns_(range_of_crowns(quantities)),
      shadow_patches_(range_of(Quantity::shadow_patches, quantities)),
      views_(view_ranges_of(quantities)),
      azimuths_(sampling_for(quantities, azimuths, manifest)),
      turns_(turns_of(azimuths_, manifest)),
      halves_(azimuths_, manifest) {
  FARLOD_EXPECTS(azimuths_for(quantities, azimuths) == azimuths);
  if (quantities.horizons > 0) {
    azimuth_of_horizon_.resize(quantities.horizons);
    const std::size_t step = azimuths / quantities.horizons;
    for (std::size_t k = 0; k < azimuths; ++k)
      if (const std::size_t n = azimuths_.order()[k]; n % step == 0) azimuth_of_horizon_[n / step] = k;
  }
  if (quantities.sky_patches != SkyPatchSet::none) divide_into_patches();
  if (quantities.sun) sun_ = sorted_by_azimuth(*quantities.sun);
  if (quantities.shade) sort_sun_of_light();
  if (!needs_light()) return;
  light_of_period_ = light ? std::move(light)
                           : std::make_shared<const LightOfPeriod>(quantities.light.value_or(Light{}), quantities.illuminance);
  light_.emplace(*light_of_period_, turns_);
}

HorizonColumns FurtherQuantities::horizon_columns() const {
  HorizonColumns columns;
  if (!quantities_.horizon_distances) return columns;
  columns.elevations = range_of(Quantity::horizon, quantities_).first;
  columns.distances = range_of(Quantity::horizon_distance, quantities_).first;
  for (const std::size_t k : azimuth_of_horizon_)
    columns.directions_grid.push_back({static_cast<double>(azimuths_.cosine()[k]), static_cast<double>(azimuths_.sine()[k])});
  return columns;
}

void FurtherQuantities::divide_into_patches() {
  const PatchBands shape = patch_bands_of(quantities_.sky_patches);
  const double half_part = 0.5 / static_cast<double>(azimuths_.size());
  const auto slope_at = [&](std::size_t n) {
    return static_cast<float>(std::tan(0.5 * std::numbers::pi * shape.height * static_cast<double>(n)));
  };
  std::uint32_t first = 0;
  for (std::size_t n = 0; n <= shape.counts.size(); ++n) {
    const bool is_zenith = n == shape.counts.size();
    Band band{slope_at(n), is_zenith ? straight_up : slope_at(n + 1), first, is_zenith ? 1 : shape.counts[n], {}};
    for (const double turn : turns_) {
      // The first patch is centred at north; the part of the turn begins in one patch, and may end in the next
      const double begin = (turn - half_part) * band.patches + 0.5, end = (turn + half_part) * band.patches + 0.5;
      const double border = std::floor(begin) + 1.0, in_first = std::clamp((border - begin) / (end - begin), 0.0, 1.0);
      const auto patch = [&](double place) {
        const double wrapped = place - band.patches * std::floor(place / band.patches);
        return first + std::min(static_cast<std::uint32_t>(wrapped), band.patches - 1);
      };
      band.of_azimuth.push_back({PatchShare{patch(std::floor(begin)), static_cast<float>(in_first)},
                                 PatchShare{patch(border), static_cast<float>(1.0 - in_first)}});
    }
    first += band.patches;
    bands_.push_back(std::move(band));
  }
}

void FurtherQuantities::evaluate(const ProfiledPacket& packet, std::span<float> values) const {
  FARLOD_EXPECTS(values.size() == packet.receivers.count * size_);
  QuantityColumns columns(size_, values);
  if (light_) find_lost_light(packet);
  for (const QuantityRow& row : quantity_table())
    if (row.add != nullptr && row.is_asked(quantities_)) (this->*row.add)(packet, columns);
  columns.skip(crowns_.count);
  FARLOD_EXPECTS(columns.count() == size_);
}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): rows of the table hold members
void FurtherQuantities::add_hidden(const ProfiledPacket& packet, QuantityColumns& columns) const {
  Lanes near, far;
  for (std::size_t l = 0; l < packet_lanes; ++l) {
    // Both skies are sampled: what is far hides something or nothing
    const float near_svf = std::max(packet.sky.near_svf[l], packet.sky.svf[l]);
    near[l] = std::max(0.0F, 0.5F * (1.0F + packet.receivers.normal_z[l]) - near_svf);
    far[l] = near_svf - packet.sky.svf[l];
  }
  columns.add(near);
  columns.add(far);
}

void FurtherQuantities::add_horizons(const ProfiledPacket& packet, QuantityColumns& columns) const {
  for (const std::size_t k : azimuth_of_horizon_) {
    Lanes degrees;
    for (std::size_t l = 0; l < packet_lanes; ++l)
      degrees[l] = static_cast<float>(Angle::radians(std::atan(static_cast<double>(packet.profile.sky_from[k][l]))).degrees());
    columns.add(degrees);
  }
}

/// Profiles do not tell them: their places are left for trace_horizon_distances.
void FurtherQuantities::add_distances(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(azimuth_of_horizon_.size());
}

/// Profiles do not tell them: their places are left for store_shadow_patches.
void FurtherQuantities::add_shadow_patches(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(shadow_patches_.count);
}

/// Profiles do not tell them: their places are left for store_view_factors, as those of the next, for ViewsAround, and for
/// store_building_views.
void FurtherQuantities::add_views(const ProfiledPacket&, QuantityColumns& columns) const { columns.skip(views_.all.count); }
void FurtherQuantities::add_views_below(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(views_.below.count);
}
void FurtherQuantities::add_views_of_cube(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(views_.cube.count);
}
void FurtherQuantities::add_views_of_sphere(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(views_.sphere.count);
}
void FurtherQuantities::add_views_of_eye(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(views_.eye.count);
}
void FurtherQuantities::add_view_of_building(const ProfiledPacket&, QuantityColumns& columns) const {
  columns.skip(views_.building.count);
}

void FurtherQuantities::add_solid(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const auto& [profile, receivers, sky, dimmed, light, rows] = packet;
  find_sky(profile, profile.solid_sky, receivers, azimuths_, true, rows);
  Lanes svf = sum(rows.terms);
  for (float& s : svf) s = std::clamp(s, 0.0F, 1.0F);
  columns.add(svf);
}

void FurtherQuantities::add_directional(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const auto& [profile, receivers, sky, dimmed, light, rows] = packet;
  find_sky(profile, profile.sky, receivers, azimuths_, false, rows);
  const Lanes all = sum(rows.terms);
  for (const std::array<double, packet_lanes>& sums : halves_.sums(rows.terms)) {
    Lanes half;
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      // What the answer knows better than the profile is not known by azimuth: it goes to both halves alike
      half[l] = std::max(0.0F, static_cast<float>(sums[l] + static_cast<double>(sky.svf[l]) - static_cast<double>(all[l])));
      if (receivers.looks_straight_up(l)) half[l] = std::min(half[l], 1.0F);
    }
    columns.add(half);
  }
}

void FurtherQuantities::add_patches(const ProfiledPacket& packet, QuantityColumns& columns) const {
  const auto& [profile, receivers, sky, dimmed, light, rows] = packet;
  for (const Band& band : bands_) {
    std::vector<std::array<double, packet_lanes>> seen(band.patches), all(band.patches);
    const auto add_to = [&](std::vector<std::array<double, packet_lanes>>& patches, const std::vector<Row>& terms) {
      for (std::size_t k = 0; k < terms.size(); ++k)
        for (const PatchShare& part : band.of_azimuth[k])
          for (std::size_t l = 0; l < packet_lanes; ++l)
            patches[part.patch - band.first_patch][l] += static_cast<double>(part.share) * static_cast<double>(terms[k][l]);
    };
    fill_rows(azimuths_.size(), band.slope_from, rows.low);
    fill_rows(azimuths_.size(), band.slope_to, rows.high);
    find_sky_between(rows.low, rows.high, receivers, azimuths_, false, rows.terms);
    add_to(all, rows.terms);
    clamp_rows(profile.sky_from, band.slope_from, band.slope_to, rows.low);
    find_sky_between(rows.low, rows.high, receivers, azimuths_, false, rows.terms);
    add_sky_in_gaps(profile, receivers, azimuths_, band.slope_from, band.slope_to, false, rows);
    add_to(seen, rows.terms);
    for (std::size_t patch = 0; patch < band.patches; ++patch) {
      Lanes share{};
      for (std::size_t l = 0; l < packet_lanes; ++l)
        if (all[patch][l] > 0.0) share[l] = static_cast<float>(std::min(1.0, seen[patch][l] / all[patch][l]));
      columns.add(share);
    }
  }
}

}  // namespace farlod
