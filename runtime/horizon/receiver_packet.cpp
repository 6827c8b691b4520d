// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/receiver_packet.hpp"

#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"

namespace farlod {
namespace {

// Distances between receivers, as lengths: weights found by trial, on streets, roofs and façades 2 m apart.
/// One metre of height counts as so many metres in the plan.
constexpr float height_weight = 1.5F;
/// Normals at right angles to each other count as so many metres, times √2.
constexpr float normal_weight_m = 60.0F;

/// The coordinates of a receiver in which packets are compact: x, y, weighted z; weighted normal. In registers of the processor,
/// so that the extents of all are found at once.
using Four = float __attribute__((vector_size(4 * sizeof(float))));
using Traits = Four;
constexpr std::size_t traits_of_place = 3, traits_of_normal = 2;

using Numbers = std::span<std::uint32_t>;

/// The interval that the receivers of a part take of one trait.
struct Extent {
  const Traits* traits = nullptr;
  std::size_t trait = 0;
  float low = 0.0F, width = 0.0F;
};
struct WidestTwo {
  Extent first, second;

  void add(const Extent& extent) {
    if (extent.width > first.width) {
      second = std::exchange(first, extent);
    } else if (extent.width > second.width) {
      second = extent;
    }
  }
};

/// Adds the extents of the first few traits.
void add_extents(const Traits* traits, std::size_t count, Numbers part, WidestTwo& widest) {
  Traits low = traits[part[0]], high = low;
  for (const std::uint32_t n : part) {
    const Traits t = traits[n];
    low = t < low ? t : low;
    high = t > high ? t : high;
  }
  for (std::size_t k = 0; k < count; ++k) widest.add({traits, k, low[k], high[k] - low[k]});
}

/// The histogram of a part along its widest trait. The part is cut within one of its bins, or between two.
constexpr std::size_t bin_count = 32;
class Bins {
 public:
  /// Stores the bin of each receiver of the part in `bins`.
  Bins(const Extent& extent, Numbers part, std::span<std::uint8_t> bins)
      : per_length_(extent.width > 0.0F ? 0.999F * bin_count / extent.width : 0.0F) {
    // Neighbors in the list are mostly of one bin: counted in turn, they need not wait for each other
    std::array<std::array<std::uint32_t, bin_count>, 4> in_turn{};
    for (std::size_t n = 0; n < part.size(); ++n) {
      bins[n] = static_cast<std::uint8_t>((extent.traits[part[n]][extent.trait] - extent.low) * per_length_);
      ++in_turn[n % in_turn.size()][bins[n]];
    }
    for (const auto& counts : in_turn)
      for (std::size_t bin = 0; bin < bin_count; ++bin) counts_[bin] += counts[bin];
  }
  [[nodiscard]] std::uint32_t count(std::size_t bin) const { return counts_[bin]; }
  /// The number of empty bins in a row that make a gap of this width.
  [[nodiscard]] std::size_t least_empty(float width) const { return static_cast<std::size_t>(width * per_length_) + 1; }

 private:
  float per_length_;
  std::array<std::uint32_t, bin_count> counts_{};
};

/// The first side of a cut: all bins before `bin`, and `of_bin` receivers of that bin; `count` in all.
struct Cut {
  std::size_t bin = 0, of_bin = 0, count = 0;
};

/// Cuts a part in half at a multiple of a packet, so that only the last packet may be partly filled.
Cut half_of(const Bins& bins, std::size_t count) {
  const std::size_t packets = (count + ReceiverPacket::lanes - 1) / ReceiverPacket::lanes;
  Cut cut{0, 0, packets / 2 * ReceiverPacket::lanes};
  std::size_t before = 0;
  while (before + bins.count(cut.bin) < cut.count) before += bins.count(cut.bin++);
  cut.of_bin = cut.count - before;
  return cut;
}

/// The cut at the widest gap that is at least as wide as a packet would be, with at least a quarter of a packet on both sides.
/// Such a gap is worth a packet more. The count is 0 when there is no such gap.
Cut widest_gap(const Bins& bins, std::size_t count, float packet_width) {
  constexpr std::size_t least = ReceiverPacket::lanes / 4;
  Cut cut;
  std::size_t before = 0, empty = 0, least_empty = bins.least_empty(packet_width);
  for (std::size_t bin = 0; bin < bin_count; ++bin) {
    if (bins.count(bin) == 0) {
      ++empty;
      continue;
    }
    if (empty >= least_empty && before >= least && count - before >= least) {
      cut = {bin, 0, before};
      least_empty = empty + 1;
    }
    before += bins.count(bin);
    empty = 0;
  }
  return cut;
}

class Division {
 public:
  Division(std::span<const Receiver> receivers, std::stop_token stop)
      : stop_(std::move(stop)), room_(receivers.size()), bins_(receivers.size()) {
    order_.numbers.resize(receivers.size());
    std::iota(order_.numbers.begin(), order_.numbers.end(), 0U);
    places_.reserve(receivers.size());
    for (const Receiver& r : receivers) places_.push_back(Traits{r.p_cell.x, r.p_cell.y, r.p_cell.z * height_weight, 0.0F});
    const auto looks_elsewhere = [&](const Receiver& r) { return r.normal != receivers[0].normal; };
    if (std::none_of(receivers.begin(), receivers.end(), looks_elsewhere)) return;
    normals_.reserve(receivers.size());
    for (const Receiver& r : receivers)
      normals_.push_back(Traits{r.normal.x * normal_weight_m, r.normal.y * normal_weight_m, 0.0F, 0.0F});
  }

  PacketOrder divided() && {
    if (!order_.numbers.empty()) divide_into_groups(order_.numbers);
    return std::move(order_);
  }

 private:
  void divide_into_groups(Numbers part) {
    if (part.size() <= packets_in_group * ReceiverPacket::lanes) {
      divide(part);
      order_.group_ends.push_back(static_cast<std::uint32_t>(order_.ends.size()));
      return;
    }
    throw_if_cancelled(stop_);
    const std::size_t count = cut(part);
    divide_into_groups(part.first(count));
    divide_into_groups(part.subspan(count));
  }
  void divide(Numbers part) {
    if (part.size() <= ReceiverPacket::lanes) {
      order_.ends.push_back(static_cast<std::uint32_t>(part.data() + part.size() - order_.numbers.data()));
      return;
    }
    const std::size_t count = cut(part);
    divide(part.first(count));
    divide(part.subspan(count));
  }
  /// Sorts the first side of the cut to the front, and returns its size. Neither side is empty.
  std::size_t cut(Numbers part) {
    WidestTwo widest;
    add_extents(places_.data(), traits_of_place, part, widest);
    if (!normals_.empty()) add_extents(normals_.data(), traits_of_normal, part, widest);
    if (widest.first.traits == nullptr) widest.first.traits = places_.data();
    const Bins bins(widest.first, part, bins_);
    const float packet_share = static_cast<float>(ReceiverPacket::lanes) / static_cast<float>(part.size());
    const Cut gap = widest_gap(bins, part.size(), std::sqrt(widest.first.width * widest.second.width * packet_share));
    return partition(part, gap.count > 0 ? gap : half_of(bins, part.size()));
  }
  /// Stable, and without a branch, which would be mispredicted every other time.
  std::size_t partition(Numbers part, const Cut& cut) {
    std::size_t here = 0, beyond = 0, of_bin = 0;
    for (std::size_t n = 0; n < part.size(); ++n) {
      const std::uint32_t number = part[n];
      const std::size_t bin = bins_[n], is_of_bin = bin == cut.bin ? 1 : 0;
      const std::size_t is_here = (bin < cut.bin ? 1U : 0U) | (is_of_bin & (of_bin < cut.of_bin ? 1U : 0U));
      part[here] = room_[beyond] = number;
      here += is_here;
      beyond += 1 - is_here;
      of_bin += is_of_bin;
    }
    std::copy_n(room_.begin(), beyond, part.begin() + static_cast<std::ptrdiff_t>(here));
    return here;
  }

  std::stop_token stop_;
  std::vector<Traits> places_, normals_;  ///< `normals_` is empty where all receivers look the same way
  PacketOrder order_;
  std::vector<std::uint32_t> room_;
  std::vector<std::uint8_t> bins_;  ///< of the part that is being cut
};

struct Interval {
  float low, high;
};
Interval interval_of(const ReceiverPacket::Lanes& lanes) {
  std::array<Four, ReceiverPacket::lanes / 4> fours;
  std::memcpy(&fours, &lanes, sizeof lanes);
  Four low = fours[0], high = low;
  for (const Four& four : fours) {
    low = four < low ? four : low;
    high = four > high ? four : high;
  }
  return {std::min(std::min(low[0], low[1]), std::min(low[2], low[3])),
          std::max(std::max(high[0], high[1]), std::max(high[2], high[3]))};
}

/// The plane through the rearmost receiver, at right angles to the normal n that all share, n_z ≥ 0. What lies behind it, and
/// below what lies behind it, is behind every receiver.
void set_plane(const ReceiverPacket& r, PacketBounds& b) {
  unsigned others = r.normal_z[0] >= 0.0F ? 0 : 1;
  ReceiverPacket::Lanes depths;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    others += (r.normal_x[l] != r.normal_x[0] ? 1U : 0U) | (r.normal_y[l] != r.normal_y[0] ? 1U : 0U) |
              (r.normal_z[l] != r.normal_z[0] ? 1U : 0U);
    depths[l] = r.normal_x[0] * r.x[l] + r.normal_y[0] * r.y[l] + r.normal_z[0] * r.z[l];
  }
  if (others > 0) return;
  b.depth = interval_of(depths).low;
  b.normal_x = r.normal_x[0];
  b.normal_y = r.normal_y[0];
  b.normal_z = r.normal_z[0];
}

}  // namespace

PacketBounds bounds_of(const ReceiverPacket& r) {
  PacketBounds b;
  const Interval x = interval_of(r.x), y = interval_of(r.y), z = interval_of(r.z);
  b.box = {0.5F * (x.low + x.high), 0.5F * (y.low + y.high), 0.5F * (x.high - x.low), 0.5F * (y.high - y.low), z.low, z.high};
  set_plane(r, b);
  return b;
}

PacketBounds joined(std::span<const PacketBounds> bounds) {
  FARLOD_EXPECTS(!bounds.empty());
  PacketBounds all = bounds.front();
  float west = std::numeric_limits<float>::infinity(), east = -west, south = west, north = -west;
  for (const PacketBounds& b : bounds) {
    west = std::min(west, b.box.x - b.box.half_x);
    east = std::max(east, b.box.x + b.box.half_x);
    south = std::min(south, b.box.y - b.box.half_y);
    north = std::max(north, b.box.y + b.box.half_y);
    all.box.low_z = std::min(all.box.low_z, b.box.low_z);
    all.box.high_z = std::max(all.box.high_z, b.box.high_z);
    // Where normals differ, no plane is in front of all: the normal 0 stays
    const bool is_shared = all.normal_x == b.normal_x && all.normal_y == b.normal_y && all.normal_z == b.normal_z;
    all.depth = std::min(all.depth, b.depth);
    if (!is_shared) all = {all.box};
  }
  all.box.x = 0.5F * (west + east);
  all.box.y = 0.5F * (south + north);
  all.box.half_x = std::max(east - all.box.x, all.box.x - west);
  all.box.half_y = std::max(north - all.box.y, all.box.y - south);
  return all;
}

PacketOrder packet_order(std::span<const Receiver> receivers, const std::stop_token& stop) {
  return Division(receivers, stop).divided();
}

}  // namespace farlod
