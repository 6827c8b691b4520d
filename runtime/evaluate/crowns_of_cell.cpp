// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/crowns_of_cell.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "farlod/box.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

constexpr std::uint32_t all_lanes = (1U << packet_lanes) - 1;
constexpr double widest_m = 5.0;

/// A packet whose other lanes stand where the first of these does: what they have is not asked for, and it is a small packet.
ReceiverPacket packet_of(const ReceiverPacket& receivers, std::uint32_t some) {
  ReceiverPacket packet = receivers;
  const auto first = static_cast<std::size_t>(std::countr_zero(some));
  for (auto member : {&ReceiverPacket::x, &ReceiverPacket::y, &ReceiverPacket::z, &ReceiverPacket::normal_x,
                      &ReceiverPacket::normal_y, &ReceiverPacket::normal_z})
    for (std::size_t l = 0; l < packet_lanes; ++l)
      if ((some >> l & 1U) == 0) (packet.*member)[l] = (packet.*member)[first];
  return packet;
}

/// The lanes in groups, none of which lies in a box with an edge of more than `widest_m`: the azimuths at which a packet may see
/// a near pixel grow with its box, and with pixels there is little else to compute.
std::vector<std::uint32_t> split(const ReceiverPacket& receivers, std::uint32_t some) {
  Box2d box;
  const auto place = [&](std::size_t l) { return Point2d{receivers.x[l], receivers.y[l]}; };
  for (std::size_t l = 0; l < packet_lanes; ++l)
    if ((some >> l & 1U) != 0) box.add(place(l));
  const Point2d edges = box.high - box.low;
  if (std::max(edges.x, edges.y) <= widest_m) return {some};
  const double middle_x = 0.5 * (box.low.x + box.high.x), middle_y = 0.5 * (box.low.y + box.high.y);
  std::uint32_t first = 0;
  for (std::size_t l = 0; l < packet_lanes; ++l)
    if (edges.x > edges.y ? place(l).x < middle_x : place(l).y < middle_y) first |= 1U << l;
  std::vector<std::uint32_t> groups = split(receivers, some & first);
  const std::vector<std::uint32_t> others = split(receivers, some & ~first);
  groups.insert(groups.end(), others.begin(), others.end());
  return groups;
}

float lowest_z(const CellReceivers& cell) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const Receiver& r : cell.receivers) lowest = std::min(lowest, r.p_cell.z);
  return lowest;
}

/// By the rule `once` a crown takes 1 − ψ at the most; by the others, several together may take all.
CanopySettings settings_of_envelopes(const CanopySettings& settings) {
  if (settings.rule == CanopyRule::once) return settings;
  return {CanopyRule::once, Season::leaf_on, 0.0};
}

}  // namespace

CanopyByPlace::CanopyByPlace(const std::vector<Crown>& crowns, const CanopySettings& settings, const AzimuthSampling& azimuths,
                             const PixelMerging& merging)
    : levels_(crowns),
      merging_(merging),
      depends_on_place_(levels_.has_pixels() && std::isfinite(merging.edges_away)),
      settings_(settings),
      sky_(azimuths) {}

CanopyByPlace::Place CanopyByPlace::place_of(const ReceiverPacket& receivers, std::size_t lane) {
  const auto number = [](float x) { return static_cast<std::int32_t>(std::floor(static_cast<double>(x) / place_m)); };
  return {number(receivers.x[lane]), number(receivers.y[lane])};
}

const CrownBatches& CanopyByPlace::batches_at(const Place& place) {
  const auto found = batches_.find(place);
  if (found != batches_.end()) return found->second;
  const Point2d corner{place.first * place_m, place.second * place_m};
  return batches_.try_emplace(place, levels_.seen_from({corner, corner + Point2d{place_m, place_m}}, merging_), settings_)
      .first->second;
}

void CanopyByPlace::evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                             std::span<CanopyShares> shares, const CanopyDetails& details) {
  if (!depends_on_place_) return sky_.evaluate(profiles, packets, batches_at({}), shares, details);
  for (std::size_t n = 0; n < packets.size(); ++n)
    shares[n] = evaluate(profiles[n], packets[n], details.of_packet(n, packets.size()));
}

CanopyShares CanopyByPlace::evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CanopyDetails& details) {
  if (!depends_on_place_) return sky_.evaluate(profile, receivers, batches_at({}), details);
  CanopyShares shares;
  behind_of_some_.resize(details.behind_of_azimuths.size());
  dimmed_of_some_.resize(details.dimmed.size());
  for (DimmedSky& dimmed : details.dimmed) dimmed.clear();
  for (std::uint32_t left = all_lanes; left != 0;) {
    const Place place = place_of(receivers, static_cast<std::size_t>(std::countr_zero(left)));
    std::uint32_t some = 0;
    for (std::size_t l = 0; l < packet_lanes; ++l) some |= place_of(receivers, l) == place ? 1U << l : 0U;
    left &= ~some;
    for (const std::uint32_t together : split(receivers, some)) {
      const CanopyShares of_some =
          sky_.evaluate(profile, packet_of(receivers, together), batches_at(place), {behind_of_some_, dimmed_of_some_});
      copy_lanes(of_some.lost, together, shares.lost);
      copy_lanes(of_some.behind, together, shares.behind);
      for (std::size_t k = 0; k < behind_of_some_.size(); ++k)
        copy_lanes(behind_of_some_[k], together, details.behind_of_azimuths[k]);
      for (std::size_t n = 0; n < dimmed_of_some_.size(); ++n) append_lanes(dimmed_of_some_[n], together, details.dimmed[n]);
    }
  }
  return shares;
}

CrownsOfCell::CrownsOfCell(const PackageReader& package, const CellReceivers& cell, const CanopySettings& settings,
                           const AzimuthSampling& azimuths, const CrownMerging& merging, const PixelMerging& pixel_merging)
    : azimuths_(azimuths),
      canopy_(bounded_canopy_around(package, cell.cell, lowest_z(cell), merging)),
      by_place_(canopy_.crowns, settings, azimuths, pixel_merging),
      envelopes_(canopy_.envelopes, settings_of_envelopes(settings)),
      sky_(azimuths) {}

PacketHorizon::Lanes CrownsOfCell::most_error(const SkyProfile& profile, const ReceiverPacket& receivers) {
  PacketHorizon::Lanes most = sky_.evaluate(profile, receivers, envelopes_, {}).lost;
  if (canopy_.highest_slope_left_out <= 0.0F) return most;
  const PacketHorizon::Lanes left_out = sky_left_out(profile, receivers);
  for (std::size_t l = 0; l < most.size(); ++l) most[l] += left_out[l];
  return most;
}

PacketHorizon::Lanes CrownsOfCell::sky_left_out(const SkyProfile& profile, const ReceiverPacket& receivers) {
  // Where a horizon jumps, its azimuth stands for up to twice its part of the turn
  constexpr float most_parts = 2.0F;
  const float highest = canopy_.highest_slope_left_out;
  from_.resize(azimuths_.size());
  to_.resize(azimuths_.size());
  between_.resize(azimuths_.size());
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const float lowest =
          profile.gap_from.empty() ? profile.sky_from[k][l] : std::min(profile.sky_from[k][l], profile.gap_from[k][l]);
      from_[k][l] = std::min(lowest, highest);
      to_[k][l] = highest;
    }
  sky_kernels().find_sky_between(from_.front().data(), to_.front().data(), receivers, azimuths_.view(), false,
                                 between_.front().data());
  PacketHorizon::Lanes sum{};
  for (const PacketHorizon::Row& row : between_)
    for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += most_parts * row[l];
  return sum;
}

}  // namespace farlod
