// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/light_kernels.hpp"

#include <cstddef>
#include <cstdint>

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

/// What comes from above a slope counts so many times.
struct LightRead {
  PlaceOfSlope place;
  Floats weight;
};

/// The receivers of a packet at an azimuth, o and w the parts of their normals along it and up.
template <bool all_look_up>
struct LitColumn {
  static constexpr std::size_t most_reads = 5;

  LightRead reads[most_reads];
  Floats outward, upward;
  SlopeInterval front;
  Floats uniform;  ///< of the reads
  std::size_t read_count = 0;
  float of_turn;  ///< the share of an azimuth

  FARLOD_LANES LitColumn(const LightScene& scene, const Normals& n, std::size_t azimuth)
      : uniform(0.0F), of_turn(1.0F / static_cast<float>(scene.azimuths.size)) {
    if constexpr (all_look_up) {
      upward = broadcast(1.0F);
      front = {broadcast(0.0F), broadcast(straight_up)};
    } else {
      outward = n.x * scene.azimuths.cosine[azimuth] + n.y * scene.azimuths.sine[azimuth];
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
    reads[read_count++] = {place_of(t), weight};
    uniform += weight * uniform_above(t);
  }
  /// One layer of all reads, of which `layer` is the value along the azimuth at the first knot and `step` leads to the next one.
  FARLOD_LANES Floats light_of(const float* layer, std::int32_t step) const {
    constexpr std::size_t up = offsetof(LightPair, up) / sizeof(float);
    Floats sum = broadcast(0.0F);
    for (std::size_t n = 0; n < read_count; ++n) {
      const Ints here = reads[n].place.knot * step;
      const auto between_knots = [&](const float* from) {
        const Floats low = gather(from, here), high = gather(from + step, here);
        return low + reads[n].place.part * (high - low);
      };
      Floats light = between_knots(layer + up);
      if constexpr (!all_look_up) light = outward * between_knots(layer) + upward * light;
      sum += reads[n].weight * light;
    }
    return sum;
  }
};

/// How much of an azimuth's part of the turn has the horizon of a neighbor, and which.
struct MovedJump {
  Floats share, beside;
  bool any;
};
template <bool all_look_up>
FARLOD_LANES MovedJump moved_jump(const LightScene& scene, std::size_t azimuth, const Floats& from,
                                  const LitColumn<all_look_up>& column) {
  constexpr float least = 2e-3F;
  const Floats zero = broadcast(0.0F), top = column.uniform_above(column.front.highest);
  const Floats here = column.uniform_above(from) - top;
  const Floats missing = load(scene.sky + azimuth * lane_count) * column.of_turn - here;
  const Mask jumps = abs(missing) >= least * column.of_turn;
  if (bits_of(jumps) == 0) return {zero, from, false};
  const std::size_t last = scene.azimuths.size - 1;
  const Floats before = load(scene.sky_from + (azimuth == 0 ? last : azimuth - 1) * lane_count),
               after = load(scene.sky_from + (azimuth == last ? 0 : azimuth + 1) * lane_count);
  // The lower of both horizons where sky is missing, otherwise the higher one
  const Floats beside = column.in_front(choose(missing > 0.0F, min(before, after), max(before, after)));
  const Floats whole = column.uniform_above(beside) - top - here;
  const Floats share = min(missing / choose(whole == 0.0F, broadcast(1.0F), whole), broadcast(1.0F));
  return {choose(jumps, choose(whole * missing > 0.0F, share, zero), zero), beside, true};
}

/// What is read of an azimuth.
template <bool all_look_up>
FARLOD_LANES void read_column(const LightScene& scene, std::size_t azimuth, LitColumn<all_look_up>& column) {
  const std::size_t row = azimuth * lane_count;
  const Floats zero = broadcast(0.0F), one = broadcast(1.0F);
  // (1) Above the horizon, and where it jumps above that of a neighbor
  const Floats from = column.in_front(load(scene.sky_from + row));
  MovedJump jump{zero, from, false};
  if (scene.sky != nullptr) jump = moved_jump(scene, azimuth, from, column);
  column.read(from, one - jump.share);
  if (jump.any) column.read(jump.beside, jump.share);
  // (2) In the gap below it
  if (scene.gap_share != nullptr) {
    const Floats share = load(scene.gap_share + row);
    if (bits_of(share > 0.0F) != 0) {
      const Floats low = column.in_front(load(scene.gap_from + row)), high = column.in_front(load(scene.gap_to + row));
      const Floats seen = choose(low < high, share, zero);
      column.read(low, seen);
      column.read(high, -seen);
    }
  }
  // (3) Not what is behind the receivers, above their own planes
  if (!all_look_up && bits_of(column.front.highest < no_light_above) != 0) column.read(column.front.highest, -one);
}

/// Adds what comes from an azimuth.
template <bool all_look_up>
FARLOD_LANES void add_column(const LightScene& scene, const Normals& normals, std::size_t azimuth, float* sums) {
  LitColumn<all_look_up> column(scene, normals, azimuth);
  read_column(scene, azimuth, column);
  if (column.read_count == 0) return;
  const auto add = [&](std::size_t layer, const Floats& light) {
    store(load(sums + layer * lane_count) + light, sums + layer * lane_count);
  };
  add(0, column.uniform);
  constexpr std::int32_t pair_floats = sizeof(LightPair) / sizeof(float);
  if (scene.wants_even) add(1, column.light_of(scene.even->along.data() + 1, pair_floats));
  const auto step = static_cast<std::int32_t>(scene.pair_count) * pair_floats;
  const LightPair* const pairs = scene.pairs + azimuth * (last_light_knot + 1) * scene.pair_count;
  for (std::size_t n = 0; n < scene.pair_count; ++n)
    for (std::size_t side = 0; side < 2; ++side) add(2 + 2 * n + side, column.light_of(pairs[n].along.data() + side, step));
}

template <bool all_look_up>
FARLOD_LANES void sum_columns(const LightScene& scene, float* sums) {
  for (std::size_t n = 0; n < 2 + 2 * std::size_t{scene.pair_count}; ++n) store(broadcast(0.0F), sums + n * lane_count);
  const Normals normals = normals_of(*scene.receivers);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) add_column<all_look_up>(scene, normals, k, sums);
}

void sum_light(const LightScene& scene, float* sums) {
  if (scene.all_look_up)
    sum_columns<true>(scene, sums);
  else
    sum_columns<false>(scene, sums);
}

}  // namespace

namespace FARLOD_TARGET {
extern const LightKernels light_kernels;
constexpr LightKernels light_kernels{.sum_light = sum_light};
}  // namespace FARLOD_TARGET

}  // namespace farlod
