// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/crown_kernels.hpp"

#include <bit>
#include <limits>

#include "canopy/crown_sections.hpp"
#include "canopy/crown_union.hpp"
#include "horizon/edge_culling.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

static_assert(ReceiverPacket::lanes == lane_count && CrownBatches::lanes == lane_count);

// --- Which crowns are seen
// -------------------------------------------------------------------------------------------------------

template <class Sky>
FARLOD_LANES void find_lowest_ground_of(const SkyRows& rows, const CrownScene& scene, float* lowest) {
  const Normals normals = normals_of(*scene.receivers);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) {
    const Sky sky = sky_at<Sky>(normals, scene.azimuths.cosine[k], scene.azimuths.sine[k]);
    const Floats above = begin_above(rows, k, sky.in_front());
    lowest[k] = min_lane(rows.gap_share == nullptr ? above : ground_of(above, window_of_gap(rows, k, sky)));
  }
}

void find_lowest_ground(const SkyRows& rows, const CrownScene& scene, float* lowest) {
  if (scene.all_look_up) return find_lowest_ground_of<SkyStraightUp>(rows, scene, lowest);
  find_lowest_ground_of<SkyOfNormals>(rows, scene, lowest);
}

/// The minima of one packet or several. A sector without azimuths has a minimum that no crown reaches.
FARLOD_LANES void find_sector_minima_of(std::span<const float* const> lowest, const std::uint32_t* first_of_sector,
                                        SectorMinHorizon& horizon) {
  // As in edge_culling.hpp. NOLINTNEXTLINE(readability-container-data-pointer)
  float* const minima = &horizon.minima[0];
  for (std::size_t s = 0; s < SectorMinHorizon::sectors; ++s) {
    float minimum = std::numeric_limits<float>::max();
    for (const float* of_packet : lowest)
      for (std::uint32_t k = first_of_sector[s]; k < first_of_sector[s + 1]; ++k)
        minimum = of_packet[k] < minimum ? of_packet[k] : minimum;
    minima[s] = minimum;
  }
  find_levels(horizon);
}

/// Sixteen crowns as seen from a packet: below which slopes and at which azimuths, with the margins of EdgeReach.
struct CrownReach {
  EdgeReach edge;
  Floats distance;
};

/// The packet's box lies within `along` of its middle towards the axis, and `across` beside that way. Of all places there, the
/// nearest corner sees the crown's side farthest aside, at α + β with sin β = across / d and sin α = a / d; the lowest and
/// nearest place sees it highest. docs/concepts.md, "Crowns".
FARLOD_LANES CrownReach reach_of(const CrownBatches::Batch& b, const CenteredBox& box) {
  const Floats x = load(b.x.data()) - box.x, y = load(b.y.data()) - box.y, radius = load(b.plan_radius.data());
  const Floats distance = sqrt(x * x + y * y), inverse = 1.0F / max(distance, broadcast(min_clearance_m));
  const Floats along = (abs(x) * box.half_x + abs(y) * box.half_y) * inverse + min_clearance_m,
               across = (abs(y) * box.half_x + abs(x) * box.half_y) * inverse + min_clearance_m;
  const Floats clearance = distance - along - radius, nearest = max(clearance, broadcast(min_clearance_m)) + radius;
  // Too close for a bound: also where rounding takes more than a part of the margin from q = |p|² − a²
  const Mask is_close = clearance < 2.0F * min_clearance_m + 0.01F * radius;
  // Azimuths: what the tangents of the corner are turned by, times d²
  const Floats tangent = sqrt(nearest * nearest + across * across - radius * radius);
  const Floats cosine = nearest * tangent - across * radius, sine = nearest * radius + across * tangent;
  const Floats from = pseudo_angle(x * cosine + y * sine, y * cosine - x * sine),
               to = pseudo_angle(x * cosine - y * sine, y * cosine + x * sine);
  // Slopes: the upper tangent of the cap
  const Floats rise = load(b.top.data()) - box.low_z, h = load(b.cap_z.data()) - box.low_z, ratio = load(b.cap_ratio.data());
  const Floats q = (nearest - radius) * (nearest + radius), slope = (nearest * h + radius * sqrt(h * h + q * ratio * ratio)) / q;
  CrownReach reach;
  reach.distance = distance;
  reach.edge.max_slope = choose(is_close, broadcast(EdgeReach::unbounded), slope * (1.0F + reach_margin) + reach_margin);
  reach.edge.max_slope = choose(rise > 0.0F, reach.edge.max_slope, broadcast(-1.0F));
  reach.edge.from = from + (1.0F - reach_margin);
  reach.edge.to = from + within_half_a_turn(to - from) + (1.0F + reach_margin);
  return reach;
}

/// Appends a crown, unless it is between two azimuths.
FARLOD_LANES void add_seen(std::uint32_t crown, std::uint32_t first, std::uint32_t end, SeenCrown bounds, const AzimuthView& a,
                           SeenCrown*& next) {
  if (bounds.max_slope == EdgeReach::unbounded) {
    first = 0;
    end = a.size;
  }
  if (first == end) return;
  bounds.crown = crown;
  bounds.first = first < a.size ? first : first < 2 * a.size ? first - a.size : first - 2 * a.size;
  bounds.count = end - first < a.size ? end - first : a.size;
  *next++ = bounds;
}

std::size_t find_seen(const CrownScene& scene, const CenteredBox& box, std::span<const float* const> lowest_of_packets,
                      SeenCrown* seen) {
  const AzimuthView& a = scene.azimuths;
  SectorMinHorizon lowest;
  find_sector_minima_of(lowest_of_packets, a.first_of_sector, lowest);
  SeenCrown* next = seen;
  for (std::size_t n = 0; n < scene.batches.size(); ++n) {
    // Above the ground in their sectors, and some of them in range
    const CrownReach reach = reach_of(scene.batches[n], box);
    const Floats nearest = max(reach.distance - (box.half_x + box.half_y + min_clearance_m), broadcast(0.0F));
    std::uint32_t kept = scene.batches[n].used & raising_edges(reach.edge, lowest);
    kept &= ~bits_of(nearest * nearest > scene.range_square);
    if (kept == 0) continue;
    const std::array first_slot = to_array(truncate(reach.edge.from * a.slots)),
                     end_slot = to_array(truncate(reach.edge.to * a.slots) + 1);
    const std::array max_slope = to_array(reach.edge.max_slope), distance = to_array(reach.distance);
    for (; kept != 0; kept &= kept - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(kept));
      add_seen(static_cast<std::uint32_t>(n * lane_count + l), a.first_of_slot[first_slot[l]], a.first_of_slot[end_slot[l]],
               {0, 0, 0, max_slope[l], distance[l]}, a, next);
    }
  }
  return static_cast<std::size_t>(next - seen);
}

// --- The union of what crowns cover
// ----------------------------------------------------------------------------------------------

/// Appends a crown to the lists of the azimuths from `begin` to `end` at which it may rise above the ground. Returns whether
/// there is any.
FARLOD_LANES bool list_crown(std::uint32_t number, float max_slope, std::uint32_t begin, std::uint32_t end, const float* lowest,
                             const CrownLists& lists) {
  std::uint32_t any = 0;
  for (std::uint32_t k = begin; k < end; k += lane_count) {
    std::uint32_t rises = bits_of(broadcast(max_slope) > load(lowest + k));
    if (end - k < lane_count) rises &= (1U << (end - k)) - 1;
    any |= rises;
    for (; rises != 0; rises &= rises - 1)
      lists.numbers[lists.ends[k + static_cast<std::uint32_t>(std::countr_zero(rises))]++] = number;
  }
  return any != 0;
}

std::size_t list(std::span<SeenCrown> seen, const float* lowest, std::uint32_t azimuths, const CrownLists& lists) {
  std::uint32_t kept = 0;
  for (const SeenCrown& s : seen) {
    const std::uint32_t end = s.first + s.count;
    bool is_listed = list_crown(kept, s.max_slope, s.first, end < azimuths ? end : azimuths, lowest, lists);
    if (end > azimuths && list_crown(kept, s.max_slope, 0, end - azimuths, lowest, lists)) is_listed = true;
    (&seen.front())[kept] = s;
    kept += is_listed ? 1 : 0;
  }
  return kept;
}

void place(const CrownScene& scene, std::span<const SeenCrown> seen, PlacedCrown* placed) {
  const Eyes eye = eyes_of(*scene.receivers);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    const CrownBatches::Batch& b = scene.batches[seen[n].crown / lane_count];
    const std::size_t lane = seen[n].crown % lane_count;
    placed[n].max_slope = seen[n].max_slope;
    if (b.shape[lane] == CrownShape::prism) {
      SquareCrown crown;
      set_prism(b, lane, eye, scene.range_square, crown);
      keep(crown, placed[n]);
    } else {
      RoundCrown crown;
      set_round(b, lane, eye, scene.range_square, crown);
      keep(crown, placed[n]);
    }
  }
}

FARLOD_LANES CutCrown cut_placed(const PlacedCrown& placed, float cosine, float sine) {
  return placed.is_prism ? cut_prism(kept_square(placed), cosine, sine) : cut_round(kept_round(placed), true, cosine, sine);
}

/// The sky of a union, whose runs are told to those who ask.
template <class Sky>
FARLOD_LANES Floats sky_of(const CrownUnion& u, const Sky& sky, const SkyWindow& above, const SkyWindow* gap,
                           const DimmedTaker& taker, std::uint32_t azimuth) {
  Floats sum{};
  for_each_run(u, [&](const Floats& from, const Floats& to, const Mask& ends) {
    Floats term = sky_within(above, sky, from, to);
    if (gap != nullptr) term += sky_within(*gap, sky, from, to);
    const Floats seen = choose(ends, term, broadcast(0.0F));
    sum += seen;
    tell_dimmed(taker, azimuth, seen, from, to, nullptr);
  });
  return sum;
}

/// The sky behind the crowns of one azimuth: those with these numbers.
// The room is written to, through the union. NOLINTBEGIN(readability-non-const-parameter)
template <class Sky, bool has_gaps>
FARLOD_LANES Floats sky_behind(const SkyRows& rows, const AzimuthView& azimuths, std::size_t k, const Normals& normals,
                               std::span<const std::uint32_t> numbers, const PlacedCrown* placed, float* room,
                               const DimmedTaker& taker) {
  const float cosine = azimuths.cosine[k], sine = azimuths.sine[k];
  const Sky sky = sky_at<Sky>(normals, cosine, sine);
  const SkyWindow above = window_above(rows, k, sky);
  SkyWindow gap{};
  if constexpr (has_gaps) gap = window_of_gap(rows, k, sky);
  CrownUnion u{.ground = above.from, .low = room, .high = room + (numbers.size() + 1) * lane_count};
  if constexpr (has_gaps) u.ground = ground_of(above.from, gap);
  for (const std::uint32_t number : numbers)
    if (bits_of(broadcast(placed[number].max_slope) > u.ground) != 0) u.join(cut_placed(placed[number], cosine, sine));
  return sky_of(u, sky, above, has_gaps ? &gap : nullptr, taker, static_cast<std::uint32_t>(k));
}
// NOLINTEND(readability-non-const-parameter)

template <class Sky, bool has_gaps>
FARLOD_LANES void sum_behind_of(const SkyRows& rows, const CrownScene& scene, const CrownLists& lists, const PlacedCrown* placed,
                                float* room, const BehindRows& wanted, float* sum) {
  const Normals normals = normals_of(*scene.receivers);
  Sum total(wanted.behind);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) {
    const std::uint32_t begin = lists.begins[k], end = lists.ends[k];
    // Where there is no crown, 0 counts as a term, since there may be one in other packets of the receiver
    total.add(begin == end ? Floats{}
                           : sky_behind<Sky, has_gaps>(rows, scene.azimuths, k, normals, {lists.numbers + begin, end - begin},
                                                       placed, room, wanted.dimmed));
  }
  store(total.total() / static_cast<float>(scene.azimuths.size), sum);
}

void sum_behind(const SkyRows& rows, const CrownScene& scene, const CrownLists& lists, const PlacedCrown* placed, float* room,
                const BehindRows& wanted, float* sum) {
  if (rows.gap_share != nullptr && scene.all_look_up)
    return sum_behind_of<SkyStraightUp, true>(rows, scene, lists, placed, room, wanted, sum);
  if (rows.gap_share != nullptr) return sum_behind_of<SkyOfNormals, true>(rows, scene, lists, placed, room, wanted, sum);
  if (scene.all_look_up) return sum_behind_of<SkyStraightUp, false>(rows, scene, lists, placed, room, wanted, sum);
  sum_behind_of<SkyOfNormals, false>(rows, scene, lists, placed, room, wanted, sum);
}

}  // namespace

namespace FARLOD_TARGET {
extern const CrownKernels crown_kernels;
constexpr CrownKernels crown_kernels{
    .find_lowest_ground = find_lowest_ground, .find_seen = find_seen, .list = list, .place = place, .sum_behind = sum_behind};
}  // namespace FARLOD_TARGET

}  // namespace farlod
