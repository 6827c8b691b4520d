// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/light_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

/// Where a slope lies among the knots: so far on from one to the next.
struct PlaceOfSlope {
  Ints knot;
  Floats part;
};
FARLOD_LANES PlaceOfSlope place_of(const Floats& slope) {
  const Floats finite = min(slope, broadcast(straight_up));
  const Floats place = static_cast<float>(last_light_knot) * (finite / (1.0F + finite));
  const Ints knot = min(truncate(place), broadcast(static_cast<std::int32_t>(last_light_knot) - 1));
  return {knot, place - to_floats(knot)};
}

/// A LightPair in a register: for each receiver, one load has what would else be gathered number by number.
using Quad = float __attribute__((vector_size(sizeof(LightPair))));
FARLOD_LANES Quad load_pair(const LightPair* pair) {
  Quad q;
  std::memcpy(&q, pair, sizeof q);
  return q;
}

/// What comes from above a slope, for sixteen receivers: `along` times what comes along the azimuth, and `up` times what comes
/// from above.
struct LightRead {
  alignas(64) std::int32_t knot[lane_count];
  alignas(64) float part[lane_count], along[lane_count], up[lane_count];
  std::size_t azimuth;

  template <bool all_look_up>
  [[nodiscard]] FARLOD_LANES Quad factor(std::size_t lane) const {
    const float a = all_look_up ? up[lane] : along[lane];
    return Quad{a, a, up[lane], up[lane]};
  }
};

/// What is read of some azimuths. The places come first, then the light at all of them: no load waits for its place.
struct LightReads {
  static constexpr std::size_t azimuths = 8, most_of_azimuth = 5;

  LightRead reads[azimuths * most_of_azimuth];
  std::size_t count = 0;
  Floats uniform{};  ///< the uniform sky of all reads

  /// Adds what all reads give of a pair. `first` is that of the lowest knot of the first azimuth; those of the next knot and of
  /// the next azimuth lie so far behind it. They are summed up before they are added, as the uniform sky is: rounding is alike.
  template <bool all_look_up>
  FARLOD_LANES void add_pair(const LightPair* first, std::ptrdiff_t to_knot, std::size_t to_azimuth, Quad* sums) const {
    for (std::size_t l = 0; l < lane_count; ++l) {
      Quad sum{};
      for (std::size_t n = 0; n < count; ++n) {
        const LightRead& read = reads[n];
        const LightPair* const here = first + read.azimuth * to_azimuth + read.knot[l] * to_knot;
        const Quad low = load_pair(here), high = load_pair(here + to_knot);
        sum += read.factor<all_look_up>(l) * (low + read.part[l] * (high - low));
      }
      sums[l] += sum;
    }
  }
};

/// The receivers of a packet at an azimuth, o and w the parts of their normals along it and up.
template <bool all_look_up>
struct LitColumn {
  Floats outward, upward;
  SlopeInterval front;
  LightReads& reads;
  std::size_t azimuth;
  float of_turn;  ///< the share of an azimuth

  FARLOD_LANES LitColumn(const AzimuthView& azimuths, const ReceiverPacket& receivers, std::size_t k, LightReads& to)
      : reads(to), azimuth(k), of_turn(1.0F / static_cast<float>(azimuths.size)) {
    if constexpr (all_look_up) {
      upward = broadcast(1.0F);
      front = {broadcast(0.0F), broadcast(straight_up)};
    } else {
      const Normals n = normals_of(receivers);
      outward = n.x * azimuths.cosine[k] + n.y * azimuths.sine[k];
      upward = n.z;
      front = slopes_in_front(outward, upward);
    }
  }

  /// The uniform sky above a slope.
  FARLOD_LANES Floats uniform_above(const Floats& t) const {
    if constexpr (all_look_up) return of_turn / (1.0F + t * t);
    return of_turn * cosine_above(t, outward, upward);
  }
  FARLOD_LANES Floats in_front(const Floats& t) const { return min(max(t, front.lowest), front.highest); }

  /// What is above a slope in front of the receivers counts so many times, unless it is as good as the zenith: of half of the
  /// azimuths, walls see nothing.
  FARLOD_LANES void read(const Floats& t, const Floats& times) {
    const Mask counts = t < no_light_above;
    if (bits_of(counts) == 0) return;
    const Floats weight = choose(counts, times, broadcast(0.0F));
    const PlaceOfSlope place = place_of(t);
    LightRead& read = reads.reads[reads.count++];
    read.azimuth = azimuth;
    store(place.knot, read.knot);
    store(place.part, read.part);
    if constexpr (!all_look_up) store(weight * outward, read.along);
    store(weight * upward, read.up);
    reads.uniform += weight * uniform_above(t);
  }
};

/// How much of an azimuth's part of the turn has the horizon of a neighbor, and which.
struct MovedJump {
  Floats share, beside;
  bool any;
};
template <bool all_look_up>
FARLOD_LANES MovedJump moved_jump(const LitPacket& packet, std::size_t azimuth_count, std::size_t azimuth, const Floats& from,
                                  const LitColumn<all_look_up>& column) {
  constexpr float least = 2e-3F;
  const Floats zero = broadcast(0.0F), top = column.uniform_above(column.front.highest);
  const Floats here = column.uniform_above(from) - top;
  const Floats missing = load(packet.sky + azimuth * lane_count) * column.of_turn - here;
  const Mask jumps = abs(missing) >= least * column.of_turn;
  if (bits_of(jumps) == 0) return {zero, from, false};
  const std::size_t last = azimuth_count - 1;
  const Floats before = load(packet.sky_from + (azimuth == 0 ? last : azimuth - 1) * lane_count),
               after = load(packet.sky_from + (azimuth == last ? 0 : azimuth + 1) * lane_count);
  // The lower of both horizons where sky is missing, otherwise the higher one
  const Floats beside = column.in_front(choose(missing > 0.0F, min(before, after), max(before, after)));
  const Floats whole = column.uniform_above(beside) - top - here;
  const Floats share = min(missing / choose(whole == 0.0F, broadcast(1.0F), whole), broadcast(1.0F));
  return {choose(jumps, choose(whole * missing > 0.0F, share, zero), zero), beside, true};
}

/// What is read of an azimuth.
template <bool all_look_up>
FARLOD_LANES void read_column(const LitPacket& packet, std::size_t azimuth_count, std::size_t azimuth,
                              LitColumn<all_look_up>& column) {
  const std::size_t row = azimuth * lane_count;
  const Floats zero = broadcast(0.0F), one = broadcast(1.0F);
  // (1) Above the horizon, and where it jumps above that of a neighbor
  const Floats from = column.in_front(load(packet.sky_from + row));
  MovedJump jump{zero, from, false};
  if (packet.sky != nullptr) jump = moved_jump(packet, azimuth_count, azimuth, from, column);
  column.read(from, one - jump.share);
  if (jump.any) column.read(jump.beside, jump.share);
  // (2) In the gap below it
  if (packet.gap_share != nullptr) {
    const Floats share = load(packet.gap_share + row);
    if (bits_of(share > 0.0F) != 0) {
      const Floats low = column.in_front(load(packet.gap_from + row)), high = column.in_front(load(packet.gap_to + row));
      const Floats seen = choose(low < high, share, zero);
      column.read(low, seen);
      column.read(high, -seen);
    }
  }
  // (3) Not what is behind the receivers, above their own planes
  if (!all_look_up && bits_of(column.front.highest < no_light_above) != 0) column.read(column.front.highest, -one);
}

/// More packets are not summed up at once.
constexpr std::size_t most_lit_packets = packets_in_group;

/// What all azimuths give a packet: the uniform sky, and [pair][receiver] of what is even and of those of azimuths.
struct LightSums {
  Floats uniform{};
  Quad pairs[most_light_pairs][lane_count]{};
};

/// Adds what comes from some azimuths to a packet.
template <bool all_look_up>
FARLOD_LANES void add_azimuths(const LightScene& scene, const LitPacket& packet, std::size_t first, std::size_t end,
                               LightSums& sums) {
  LightReads reads;
  for (std::size_t k = first; k < end; ++k) {
    LitColumn<all_look_up> column(scene.azimuths, *packet.receivers, k, reads);
    read_column(packet, scene.azimuths.size, k, column);
  }
  sums.uniform += reads.uniform;
  if (scene.wants_even) reads.add_pair<all_look_up>(scene.even, 1, 0, sums.pairs[0]);
  const std::size_t to_azimuth = (last_light_knot + 1) * std::size_t{scene.pair_count};
  for (std::size_t n = 0; n < scene.pair_count; ++n)
    reads.add_pair<all_look_up>(scene.pairs + n, static_cast<std::ptrdiff_t>(scene.pair_count), to_azimuth, sums.pairs[n + 1]);
}

/// Both layers of a pair. A level receiver gets what comes from above.
FARLOD_LANES void store_layers(const Quad* pair, bool all_look_up, float* layers) {
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t l = 0; l < lane_count; ++l)
      layers[side * lane_count + l] = all_look_up ? pair[l][side + 2] : pair[l][side] + pair[l][side + 2];
}

/// Some azimuths at a time, so that their light is in the processor's cache for all packets.
void sum_light_of(const LightScene& scene, std::span<const LitPacket> packets) {
  LightSums sums[most_lit_packets];
  for (std::size_t first = 0; first < scene.azimuths.size; first += LightReads::azimuths) {
    const std::size_t left = scene.azimuths.size - first,
                      end = left < LightReads::azimuths ? first + left : first + LightReads::azimuths;
    for (std::size_t n = 0; n < packets.size(); ++n)
      if (packets[n].all_look_up)
        add_azimuths<true>(scene, packets[n], first, end, sums[n]);
      else
        add_azimuths<false>(scene, packets[n], first, end, sums[n]);
  }
  for (std::size_t n = 0; n < packets.size(); ++n) {
    for (std::size_t pair = 0; pair <= scene.pair_count; ++pair)
      store_layers(sums[n].pairs[pair], packets[n].all_look_up, packets[n].sums + 2 * pair * lane_count);
    store(sums[n].uniform, packets[n].sums);
  }
}

void sum_light(const LightScene& scene, std::span<const LitPacket> packets) {
  for (std::size_t n = 0; n < packets.size(); n += most_lit_packets)
    sum_light_of(scene, packets.subspan(n, packets.size() - n < most_lit_packets ? packets.size() - n : most_lit_packets));
}

}  // namespace

namespace FARLOD_TARGET {
extern const LightKernels light_kernels;
constexpr LightKernels light_kernels{.sum_light = sum_light};
}  // namespace FARLOD_TARGET

}  // namespace farlod
