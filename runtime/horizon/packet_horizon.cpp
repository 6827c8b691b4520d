// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_horizon.hpp"

#include <limits>

#include "base/expects.hpp"

namespace farlod {
namespace {

bool all_are_level(const ReceiverPacket& r) {
  return std::all_of(r.normal_z.begin(), r.normal_z.end(), [](float z) { return z == 0.0F; });
}

/// Fewer packets are faster alone.
constexpr std::size_t least_packets = 4;

}  // namespace

void PacketHorizon::clear() {
  std::fill(slopes_.begin(), slopes_.end(), Row{});
  std::fill(numbers_.begin(), numbers_.end(), no_edges());
  drawn_.clear();
}

void PacketHorizon::set_slopes(const PacketHorizon& other) {
  slopes_ = other.slopes_;
  std::fill(numbers_.begin(), numbers_.end(), no_edges());
  drawn_.clear();
}

void PacketHorizon::begin_above(const PacketHorizon& other) {
  edges_ = other.edges_;
  slopes_ = other.slopes_;
  numbers_ = other.numbers_;
  drawn_.clear();
}

void PacketHorizon::raise(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketBounds& bounds,
                          Culling culling) {
  if (edges.empty()) return;
  DrawnRows rows{data(), numbers(), {}};
  if (tracks_edges()) rows.drawn = drawn_.room_for(edges.batches().size() * SilhouetteEdges::lanes);
  drawn_.added(
      edge_kernels().raise_to_edges({edges.batches(), edges.role()}, receivers, bounds, azimuths_->view(), culling, rows));
}

void PacketHorizon::set_to_lowest(const SilhouetteEdges& edges, const ReceiverPacket& receivers,
                                  const PacketHorizon& min_horizon) {
  // Infinite, then lowered to the edges, then the minimum where no edge is seen
  Row infinite;
  infinite.fill(std::numeric_limits<float>::infinity());
  std::fill(slopes_.begin(), slopes_.end(), infinite);
  if (!edges.empty())
    edge_kernels().lower_to_edges({edges.batches(), edges.role()}, receivers, bounds_of(receivers), azimuths_->view(),
                                  min_horizon.data(), data());
  sky_kernels().replace_infinite(min_horizon.data(), slopes_.size(), data());
}

void PacketHorizon::raise(std::span<const float> row, const Lanes& caps, std::span<const std::uint32_t> bin_of_azimuth) {
  FARLOD_EXPECTS(bin_of_azimuth.size() == slopes_.size());
  sky_kernels().raise_to_row(row.data(), caps.data(), bin_of_azimuth.data(), slopes_.size(), data());
}

void PacketHorizon::raise(const ResidualRows& rows, std::span<const std::uint32_t> bin_of_azimuth) {
  FARLOD_EXPECTS(bin_of_azimuth.size() == slopes_.size());
  sky_kernels().raise_between_rows(rows, bin_of_azimuth.data(), slopes_.size(), data(), numbers());
}

void PacketHorizon::raise_to(const PacketHorizon& other) {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size() && (numbers_.empty() || !other.numbers_.empty()));
  for (std::size_t k = 0; k < numbers_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      numbers_[k][l] = other.slopes_[k][l] > slopes_[k][l] ? other.numbers_[k][l] : numbers_[k][l];
  sky_kernels().raise(other.data(), slopes_.size(), data());
  if (tracks_edges()) drawn_.add(other.drawn_);
}

void PacketHorizon::lower_to(const PacketHorizon& other) {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size());
  sky_kernels().lower(other.data(), slopes_.size(), data());
}

void PacketHorizon::join(const PacketHorizon& lower, const PacketHorizon& upper) {
  FARLOD_EXPECTS(lower.slopes_.size() == slopes_.size() && upper.slopes_.size() == slopes_.size());
  sky_kernels().join(lower.data(), upper.data(), slopes_.size(), data());
}

void PacketHorizon::close(std::uint32_t receivers) {
  if (receivers == 0) return;
  for (Row& row : slopes_)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (((receivers >> l) & 1U) != 0) row[l] = std::numeric_limits<float>::infinity();
}

std::uint32_t PacketHorizon::exceeds(const PacketHorizon& other) const {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size());
  Lanes differences;
  sky_kernels().find_max_difference(data(), other.data(), slopes_.size(), differences.data());
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) bits |= differences[l] > 0.0F ? 1U << l : 0U;
  return bits;
}

PacketHorizon::Lanes PacketHorizon::count_above(std::span<const float> ray_slopes) const {
  FARLOD_EXPECTS(ray_slopes.size() == slopes_.size());
  Lanes counts;
  sky_kernels().count_above(data(), ray_slopes.data(), slopes_.size(), counts.data());
  return counts;
}

PacketHorizon::Lanes PacketHorizon::sky_above(SkyWeight weight, const ReceiverPacket& receivers,
                                              std::span<Row> of_azimuths) const {
  FARLOD_EXPECTS(of_azimuths.empty() || of_azimuths.size() == slopes_.size());
  const SkyKernels& kernels = sky_kernels();
  float* const rows = of_azimuths.empty() ? nullptr : of_azimuths.front().data();
  Lanes sums{};
  // The mean over the azimuths, by the cheapest kernel that fits the normals
  if (weight == SkyWeight::solid_angle)
    kernels.sum_solid_angle(data(), receivers, azimuths_->view(), sums.data(), rows);
  else if (receivers.all_look_straight_up())
    kernels.sum_cosine_up(data(), slopes_.size(), sums.data(), rows);
  else if (all_are_level(receivers))
    kernels.sum_cosine_level(data(), receivers, azimuths_->view(), sums.data(), rows);
  else
    kernels.sum_cosine(data(), receivers, azimuths_->view(), sums.data(), rows);
  for (float& s : sums) s = std::clamp(s / static_cast<float>(slopes_.size()), 0.0F, 1.0F);
  return sums;
}

std::span<const SkyJump> PacketHorizon::find_jumps(std::span<const Row> sky_of_azimuths, float least,
                                                   std::span<SkyJump> room) const {
  FARLOD_EXPECTS(numbers_.size() == slopes_.size() && sky_of_azimuths.size() == slopes_.size() && room.size() == slopes_.size());
  return room.first(
      sky_kernels().find_jumps(sky_of_azimuths.front().data(), numbers_.front().data(), slopes_.size(), least, room.data()));
}

void PacketHorizon::find_sky_below(const PacketHorizon& higher, SkyWeight weight, const ReceiverPacket& receivers,
                                   std::vector<Row>& rows) const {
  FARLOD_EXPECTS(higher.slopes_.size() == slopes_.size());
  rows.resize(slopes_.size());
  sky_kernels().find_sky_between(data(), higher.data(), receivers, azimuths_->view(), weight == SkyWeight::solid_angle,
                                 rows.front().data());
}

void PacketGroup::raise(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                        std::span<PacketHorizon> horizons) {
  FARLOD_EXPECTS(packets.size() == horizons.size());
  if (packets.size() < least_packets || edges.empty()) {
    for (std::size_t n = 0; n < packets.size(); ++n) horizons[n].raise(edges, packets[n]);
    return;
  }
  bounds_.clear();
  for (const ReceiverPacket& packet : packets) bounds_.push_back(bounds_of(packet));
  // The packet in the middle goes first: most of what it sees in the end, the others see too
  const std::size_t middle = packets.size() / 2;
  const RaisingAt where = horizons[middle].tracks_edges() ? RaisingAt::wedges : RaisingAt::azimuths;
  horizons[middle].raise(edges, packets[middle], bounds_[middle], Culling::nothing_drawn);
  find_raising(edges, bounds_[middle], horizons.subspan(middle, 1), where, first_);
  drawn_.assign(edges, first_);
  for (std::size_t n = 0; n < packets.size(); ++n)
    if (n != middle) horizons[n].raise(drawn_, packets[n], bounds_[n], Culling::mostly_seen);
  // Then those of the other edges that may rise above some of the horizons that this gave
  find_raising(edges, joined(bounds_), horizons, where, others_);
  for (std::size_t batch = 0; batch < others_.size(); ++batch) others_[batch] &= static_cast<std::uint16_t>(~first_[batch]);
  drawn_.assign(edges, others_);
  for (std::size_t n = 0; n < packets.size(); ++n)
    if (n != middle) horizons[n].raise(drawn_, packets[n], bounds_[n], Culling::mostly_drawn);
}

void PacketGroup::keep_raising(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                               std::span<const PacketHorizon> horizons, RaisingAt where, SilhouetteEdges& kept) {
  others_.clear();
  if (!edges.empty()) {
    bounds_.clear();
    for (const ReceiverPacket& packet : packets) bounds_.push_back(bounds_of(packet));
    find_raising(edges, joined(bounds_), horizons, where, others_);
  }
  kept.assign(edges, others_);
}

void PacketGroup::find_raising(const SilhouetteEdges& edges, const PacketBounds& bounds, std::span<const PacketHorizon> horizons,
                               RaisingAt where, std::vector<std::uint16_t>& raising) {
  slopes_.clear();
  for (const PacketHorizon& horizon : horizons) slopes_.push_back(horizon.slopes());
  raising.resize(edges.batches().size());
  edge_kernels().find_raising({edges.batches(), edges.role()}, bounds, slopes_, azimuths_.view(), where, raising.data());
}

}  // namespace farlod
