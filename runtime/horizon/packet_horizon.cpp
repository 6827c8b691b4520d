// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_horizon.hpp"

#include <algorithm>
#include <limits>

#include "farlod/expects.hpp"
#include "horizon/horizon_kernel.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

namespace farlod {
namespace {

using Lanes = ReceiverPacket::Lanes;

FARLOD_FOR_EACH_PROCESSOR
void sum_cosine_up(const float* slopes, std::size_t azimuth_count, float* sums) {
  Floats sum{};
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    const Floats t = load(slopes + k * lane_count);
    sum += 1.0F / (1.0F + t * t);
  }
  store(sum, sums);
}

/// Of receivers that look level, as on walls: only the azimuths in front count, up to the zenith.
FARLOD_FOR_EACH_PROCESSOR
void sum_cosine_level(const float* slopes, const ReceiverPacket& receivers, const AzimuthRing& ring, float* sums) {
  const Floats x = load(receivers.normal_x.data()), y = load(receivers.normal_y.data());
  Floats sum{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Floats outward = max(x * ring.cosine()[k] + y * ring.sine()[k], broadcast(0.0F));
    if (max_lane(outward) == 0.0F) continue;
    const Floats t = min(load(slopes + k * lane_count), broadcast(straight_up));
    sum += cosine_above(t, outward, broadcast(0.0F));
  }
  store(sum, sums);
}

FARLOD_FOR_EACH_PROCESSOR
void sum_cosine(const float* slopes, const ReceiverPacket& receivers, const AzimuthRing& ring, float* sums) {
  const Normals n = normals_of(receivers);
  Floats sum{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Floats outward = n.x * ring.cosine()[k] + n.y * ring.sine()[k];
    const LookedAt between = looked_at(outward, n.z);
    const Floats t = min(max(load(slopes + k * lane_count), between.lowest), between.highest);
    sum += cosine_above(t, outward, n.z) - cosine_above(between.highest, outward, n.z);
  }
  store(sum, sums);
}

FARLOD_FOR_EACH_PROCESSOR
void sum_solid_angle(const float* slopes, const ReceiverPacket& receivers, const AzimuthRing& ring, float* sums) {
  const Normals n = normals_of(receivers);
  Floats sum{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LookedAt between = looked_at(n.x * ring.cosine()[k] + n.y * ring.sine()[k], n.z);
    const Floats t = min(max(load(slopes + k * lane_count), between.lowest), between.highest);
    sum += solid_angle_above(t) - solid_angle_above(between.highest);
  }
  store(sum, sums);
}

FARLOD_FOR_EACH_PROCESSOR
void sky_between(const float* low, const float* high, const ReceiverPacket& receivers, const AzimuthRing& ring, bool is_solid,
                 float* rows) {
  const Normals n = normals_of(receivers);
  const float share = 1.0F / static_cast<float>(ring.size());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Floats from = load(low + k * lane_count), to = load(high + k * lane_count);
    float* row = rows + k * lane_count;
    if (max_lane(to - from) == 0.0F) {
      store(Floats{}, row);
      continue;
    }
    const float cosine = ring.cosine()[k], sine = ring.sine()[k];
    const Floats sky = sky_of_azimuth(from, n, cosine, sine, is_solid) - sky_of_azimuth(to, n, cosine, sine, is_solid);
    store(max(sky, broadcast(0.0F)) * share, row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void lower_rows(const float* other, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    store(min(load(row), load(other + k * lane_count)), row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void raise_rows_to(const float* other, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    store(max(load(row), load(other + k * lane_count)), row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void replace_rows(float what, const float* by, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    const Floats now = load(row);
    store(now < what ? now : load(by + k * lane_count), row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void join_rows(const float* lower, const float* upper, std::size_t azimuth_count, float* slopes) {
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* row = slopes + k * lane_count;
    const Floats here = load(row), begin = load(lower + k * lane_count);
    const Floats end = begin > here ? broadcast(0.0F) : load(upper + k * lane_count);
    store(max(here, end), row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void find_greatest_difference(const float* slopes, const float* other, std::size_t azimuth_count, float* differences) {
  Floats greatest_yet = broadcast(-1.0F);
  for (std::size_t k = 0; k < azimuth_count; ++k)
    greatest_yet = max(greatest_yet, load(slopes + k * lane_count) - load(other + k * lane_count));
  store(greatest_yet, differences);
}

FARLOD_FOR_EACH_PROCESSOR
void raise_between(const PacketHorizon::RowsBetween& rows, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count,
                   float* slopes) {
  const Floats shares = load(rows.shares.data()), caps = load(rows.caps.data());
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    const std::uint32_t bin = bin_of_azimuth[k];
    const float here = rows.here[bin], rise = rows.above[bin] - here;
    const Floats estimate = min(max(here + shares * rise, broadcast(rows.lower[bin])), broadcast(rows.upper[bin]));
    float* row = slopes + k * lane_count;
    store(max(load(row), min(estimate, caps)), row);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void raise_alike(const float* row, const float* caps, const std::uint32_t* bin_of_azimuth, std::size_t azimuth_count,
                 float* slopes) {
  const Floats highest = load(caps);
  for (std::size_t k = 0; k < azimuth_count; ++k) {
    float* lanes = slopes + k * lane_count;
    store(max(load(lanes), min(broadcast(row[bin_of_azimuth[k]]), highest)), lanes);
  }
}

FARLOD_FOR_EACH_PROCESSOR
void count_rows(const float* rows, const float* slopes, std::size_t azimuth_count, float* counts) {
  Floats count{};
  for (std::size_t k = 0; k < azimuth_count; ++k) count += load(rows + k * lane_count) < slopes[k] ? broadcast(1.0F) : broadcast(0.0F);
  store(count, counts);
}

bool look_straight_up(const ReceiverPacket& r) {
  bool all_do = true;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
    all_do = all_do && r.normal_x[l] == 0.0F && r.normal_y[l] == 0.0F && r.normal_z[l] > 0.0F;
  return all_do;
}

bool look_level(const ReceiverPacket& r) {
  return std::all_of(r.normal_z.begin(), r.normal_z.end(), [](float z) { return z == 0.0F; });
}

}  // namespace

void PacketHorizon::clear() { std::fill(slopes_.begin(), slopes_.end(), Row{}); }

void PacketHorizon::raise(std::span<const float> row, const Lanes& caps, std::span<const std::uint32_t> bin_of_azimuth) {
  FARLOD_EXPECTS(bin_of_azimuth.size() == slopes_.size());
  raise_alike(row.data(), caps.data(), bin_of_azimuth.data(), slopes_.size(), slopes_.front().data());
}

void PacketHorizon::raise(const RowsBetween& rows, std::span<const std::uint32_t> bin_of_azimuth) {
  FARLOD_EXPECTS(bin_of_azimuth.size() == slopes_.size());
  raise_between(rows, bin_of_azimuth.data(), slopes_.size(), slopes_.front().data());
}

void PacketHorizon::raise(const SilhouetteEdges& edges, const ReceiverPacket& receivers) {
  raise_horizons(edges, receivers, *ring_, slopes_.front().data());
}

PacketHorizon::Lanes PacketHorizon::count_over(std::span<const float> slopes) const {
  FARLOD_EXPECTS(slopes.size() == slopes_.size());
  Lanes counts;
  count_rows(slopes_.front().data(), slopes.data(), slopes_.size(), counts.data());
  return counts;
}

std::uint32_t PacketHorizon::above(const PacketHorizon& other) const {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size());
  Lanes differences;
  find_greatest_difference(slopes_.front().data(), other.slopes_.front().data(), slopes_.size(), differences.data());
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) bits |= differences[l] > 0.0F ? 1U << l : 0U;
  return bits;
}

void PacketHorizon::close(std::uint32_t receivers) {
  if (receivers == 0) return;
  for (Row& row : slopes_)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (((receivers >> l) & 1U) != 0) row[l] = std::numeric_limits<float>::infinity();
}

void PacketHorizon::raise_to(const PacketHorizon& other) {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size());
  raise_rows_to(other.slopes_.front().data(), slopes_.size(), slopes_.front().data());
}

void PacketHorizon::join(const PacketHorizon& lower, const PacketHorizon& upper) {
  FARLOD_EXPECTS(lower.slopes_.size() == slopes_.size() && upper.slopes_.size() == slopes_.size());
  join_rows(lower.slopes_.front().data(), upper.slopes_.front().data(), slopes_.size(), slopes_.front().data());
}

void PacketHorizon::become_lowest(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketHorizon& floors) {
  constexpr float none = std::numeric_limits<float>::infinity();
  Row nothing;
  nothing.fill(none);
  std::fill(slopes_.begin(), slopes_.end(), nothing);
  const float* floor_slopes = floors.slopes_.front().data();
  lower_to_edges(edges, receivers, *ring_, floor_slopes, slopes_.front().data());
  replace_rows(none, floor_slopes, slopes_.size(), slopes_.front().data());
}

void PacketHorizon::lower_to(const PacketHorizon& other) {
  FARLOD_EXPECTS(other.slopes_.size() == slopes_.size());
  lower_rows(other.slopes_.front().data(), slopes_.size(), slopes_.front().data());
}

void PacketHorizon::find_sky_below(const PacketHorizon& higher, SkyWeight weight, const ReceiverPacket& receivers,
                                   std::vector<Row>& rows) const {
  FARLOD_EXPECTS(higher.slopes_.size() == slopes_.size());
  rows.resize(slopes_.size());
  sky_between(slopes_.front().data(), higher.slopes_.front().data(), receivers, *ring_, weight == SkyWeight::solid_angle,
              rows.front().data());
}

PacketHorizon::Lanes PacketHorizon::sky_above(SkyWeight weight, const ReceiverPacket& receivers) const {
  Lanes sums{};
  const float* slopes = slopes_.front().data();
  if (weight == SkyWeight::solid_angle)
    sum_solid_angle(slopes, receivers, *ring_, sums.data());
  else if (look_straight_up(receivers))
    sum_cosine_up(slopes, slopes_.size(), sums.data());
  else if (look_level(receivers))
    sum_cosine_level(slopes, receivers, *ring_, sums.data());
  else
    sum_cosine(slopes, receivers, *ring_, sums.data());
  for (float& s : sums) s = std::clamp(s / static_cast<float>(slopes_.size()), 0.0F, 1.0F);
  return sums;
}

}  // namespace farlod
