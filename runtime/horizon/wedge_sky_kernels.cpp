// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"
#include "horizon/wedge_kernels.hpp"
#include "horizon/wedge_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end. Formulas and symbols are those of docs/concepts.md, "The sky of a wedge".

namespace farlod {
namespace {

/// Horizons raised to the receivers' own planes, below which they see nothing: the plane is one more edge. Behind a wall all is
/// hidden.
void raise_to_planes(const float* slopes, const std::int32_t* numbers, const ReceiverPacket& r, const AzimuthView& a,
                     float* raised, std::int32_t* raised_numbers) {
  const Normals n = normals_of(r);
  constexpr float level = 1e-6F;
  const Floats tilted_up = choose(n.z > level, broadcast(1.0F), broadcast(0.0F));
  const Floats inverse = 1.0F / choose(n.z > level, n.z, broadcast(1.0F));
  for (std::size_t k = 0; k < a.size; ++k) {
    const std::size_t at = k * lane_count;
    const Floats outward = n.x * a.cosine[k] + n.y * a.sine[k], horizon = min(load(slopes + at), broadcast(straight_up));
    const Floats plane = min(-outward * inverse, broadcast(straight_up));
    const Ints number = load(numbers + at);
    const Mask is_plane = choose(tilted_up > 0.5F, plane - horizon, broadcast(-1.0F)) > 0.0F;
    const Mask is_behind = choose(abs(n.z) > level, broadcast(-1.0F), -outward) >= 0.0F;
    const Floats above = choose(is_plane, plane, horizon);
    store(choose(is_behind, broadcast(straight_up), above), raised + at);
    store(choose(is_behind, broadcast(std::int32_t{number_behind}),
                 choose(is_plane, broadcast(std::int32_t{number_of_plane}), number)),
          raised_numbers + at);
  }
}

// --- Simple wedges
// ----------------------------------------------------------------------------------------------------------------

/// For the receivers for whom a wedge is simple 1, else 0.
FARLOD_LANES Floats simple_of(const NumberedHorizon& h, std::size_t at, std::size_t next, const Floats& rising,
                              const Floats& lower) {
  const Mask is_same = load(h.numbers + at) == load(h.numbers + next);
  return choose(is_same, choose(rising > lower, broadcast(0.0F), broadcast(1.0F)), broadcast(0.0F));
}

/// A simple wedge, and what hides its sky besides: for receivers that look up, bounds follow; for others, it is not simple.
struct SimpleWedge {
  Floats simple, arc, lower, higher, least, most;
};
template <WedgeWeight weight>
FARLOD_LANES void add_simple(const SimpleWedge& s, const WedgeShape& w, Sum& low, Sum& high) {
  const Floats sky = s.simple * s.arc;
  if (weight != WedgeWeight::cosine_up || !(max_lane(max(s.least, s.most) - s.lower) > 0.0F)) {
    low.add(sky);
    high.add(sky);
    return;
  }
  const auto above = [&](const Floats& slope) { return s.simple * (w.angle / (1.0F + slope * slope)); };
  const Floats lid = max(s.higher * w.widened, min(s.most, broadcast(straight_up)));
  low.add(choose(s.most > s.lower, above(lid), sky));
  high.add(choose(s.least > s.lower, min(sky, above(s.least)), sky));
}

template <WedgeWeight weight>
FARLOD_LANES void sum_simple_by(const NumberedHorizon& h, const HidingRows& hiding, const ReceiverPacket& r, const AzimuthView& a,
                                const WedgeShape& w, std::uint16_t* others, const float* tops, SimpleSums& sums) {
  Sum low(sums.low_rows), high(sums.high_rows);
  const Normals n = normals_of(r);
  // Several at once: roots and divisions of one would wait for each other
  constexpr std::size_t at_once = 4;
  const auto after = [&](std::size_t k) { return k + 1 < a.size ? k + 1 : 0; };
  const auto slopes = [&](std::size_t k) { return min(load(h.slopes + k * lane_count), broadcast(straight_up)); };
  for (std::size_t first = 0; first < a.size; first += at_once) {
    Floats arcs[at_once];
    for (std::size_t m = 0; m < at_once; ++m) {
      const std::size_t k = std::min<std::size_t>(first + m, a.size - 1), next = after(k);
      arcs[m] = sky_above<weight>({a.cosine[k], a.sine[k], a.cosine[next], a.sine[next], slopes(k), slopes(next)}, n, w);
    }
    for (std::size_t k = first; k < std::min<std::size_t>(first + at_once, a.size); ++k) {
      const std::size_t at = k * lane_count, next = after(k) * lane_count;
      const Floats t = load(h.slopes + at), u = load(h.slopes + next), top = load(tops + at);
      SimpleWedge s{{}, arcs[k - first], min(t, u), max(t, u), load(hiding.least + at), load(hiding.most + at)};
      const Floats rising = weight == WedgeWeight::cosine_up ? top : max(top, max(s.least, s.most));
      s.simple = simple_of(h, at, next, rising, s.lower);
      others[k] = static_cast<std::uint16_t>(bits_of(s.simple < 0.5F));
      add_simple<weight>(s, w, low, high);
    }
  }
  store(low.total(), sums.low);
  store(high.total(), sums.high);
}

void sum_simple(const NumberedHorizon& h, const HidingRows& hiding, const ReceiverPacket& r, const AzimuthView& a,
                const WedgeShape& w, WedgeWeight weight, std::uint16_t* others, const float* tops, SimpleSums& sums) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return sum_simple_by<WedgeWeight::cosine_up>(h, hiding, r, a, w, others, tops, sums);
    case WedgeWeight::cosine:
      return sum_simple_by<WedgeWeight::cosine>(h, hiding, r, a, w, others, tops, sums);
    case WedgeWeight::solid_angle:
      return sum_simple_by<WedgeWeight::solid_angle>(h, hiding, r, a, w, others, tops, sums);
  }
}

template <WedgeWeight weight>
FARLOD_LANES void find_simple_gaps_by(const NumberedHorizon& h, const AskedBorders& asked, const ReceiverPacket& r,
                                      const AzimuthView& a, const WedgeShape& w, std::uint16_t* others, const float* tops,
                                      float* gaps) {
  const Normals n = normals_of(r);
  const Floats none = broadcast(0.0F);
  for (std::size_t k = 0; k < a.size; ++k) {
    if (asked.wedges[k] == 0) continue;
    const std::size_t after = k + 1 < a.size ? k + 1 : 0, at = k * lane_count, next = after * lane_count;
    const Floats t = load(h.slopes + at), u = load(h.slopes + next), lower = min(t, u);
    const Floats simple = simple_of(h, at, next, load(tops + at), lower), border = load(asked.borders + at);
    others[k] = static_cast<std::uint16_t>(bits_of(simple < 0.5F));
    const Floats outward = most_outward(n.x * a.cosine[k] + n.y * a.sine[k], n.x * a.cosine[after] + n.y * a.sine[after], w);
    Floats sky = most_sky_between<weight>(lower, border, outward, n.z, w.angle);
    if constexpr (weight == WedgeWeight::cosine_up) {
      // Above the edge itself
      const Floats above = min(border, broadcast(straight_up));
      const Arc arc{
          a.cosine[k], a.sine[k], a.cosine[after], a.sine[after], min(t, broadcast(straight_up)), min(u, broadcast(straight_up))};
      sky = min(sky, max(sky_above<weight>(arc, n, w) - w.angle / (1.0F + above * above), none));
    }
    store(choose(border > lower, simple * sky, none), gaps + at);
  }
}

void find_simple_gaps(const NumberedHorizon& h, const AskedBorders& asked, const ReceiverPacket& r, const AzimuthView& a,
                      const WedgeShape& w, WedgeWeight weight, std::uint16_t* others, const float* tops, float* gaps) {
  switch (weight) {
    case WedgeWeight::cosine_up:
      return find_simple_gaps_by<WedgeWeight::cosine_up>(h, asked, r, a, w, others, tops, gaps);
    case WedgeWeight::cosine:
      return find_simple_gaps_by<WedgeWeight::cosine>(h, asked, r, a, w, others, tops, gaps);
    case WedgeWeight::solid_angle:
      return find_simple_gaps_by<WedgeWeight::solid_angle>(h, asked, r, a, w, others, tops, gaps);
  }
}

}  // namespace

namespace FARLOD_TARGET {
extern const WedgeSkyKernels wedge_sky_kernels;
constexpr WedgeSkyKernels wedge_sky_kernels{raise_to_planes, sum_simple, find_simple_gaps};
}  // namespace FARLOD_TARGET

}  // namespace farlod
