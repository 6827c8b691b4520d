// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_kernels.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/facet_culling.hpp"
#include "horizon/gap_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

using Batch = OverhangFacets::Batch;

// --- Which facets matter
// ------------------------------------------------------------------------------------------------------------

void find_gaps(const float* sky, std::size_t azimuth_count, std::uint16_t* receivers) {
  for (std::size_t k = 0; k < azimuth_count; ++k)
    receivers[k] = static_cast<std::uint16_t>(bits_of(load(sky + k * lane_count) > 0.0F));
}

void find_lowest(std::span<const float* const> horizons, const AzimuthView& azimuths, RaisingAt where, LowestOfSectors& lowest) {
  SectorMinHorizon found;
  find_sector_minima(horizons, azimuths, where == RaisingAt::wedges ? SectorAzimuths::and_beside : SectorAzimuths::inside, found);
  lowest = found.minima;
}

void find_above(const FacetsInBoxes& facets, const PacketBounds& bounds, const LowestOfSectors& lowest, std::uint16_t* found) {
  const SectorMinHorizon horizon{lowest};
  for (std::size_t n = 0; n < facets.batches.size(); ++n) found[n] = 0;
  for (std::size_t n = 0; n < facets.boxes.size(); ++n)
    for (std::uint32_t boxes = raising_edges(reach_of_boxes(facets.boxes[n], bounds), horizon); boxes != 0; boxes &= boxes - 1) {
      const std::size_t batch = n * lane_count + static_cast<std::size_t>(std::countr_zero(boxes));
      if (batch >= facets.batches.size()) break;
      found[batch] = static_cast<std::uint16_t>(raising_edges(reach_of_facets(facets.batches[batch], bounds), horizon));
    }
}

void find_bins(std::span<const Batch> facets, const CenteredBox& box, const std::uint16_t* found, std::int32_t* bins_of_facets) {
  constexpr auto sectors = static_cast<std::int32_t>(GapKernels::sectors_of_ring);
  for (std::size_t number = 0; number < facets.size(); ++number) {
    if (found[number] == 0) continue;
    const Batch& batch = facets[number];
    // The distance of the box around a facet, and the azimuth of its middle
    Floats low_x = broadcast(infinite), low_y = low_x, high_x = broadcast(-infinite), high_y = high_x;
    for (std::size_t n = 0; n < 3; ++n) {
      const Floats x = load(batch.x[n].data()) - box.x, y = load(batch.y[n].data()) - box.y;
      low_x = min(low_x, x);
      low_y = min(low_y, y);
      high_x = max(high_x, x);
      high_y = max(high_y, y);
    }
    const Floats x = max(max(low_x, -high_x), broadcast(0.0F)), y = max(max(low_y, -high_y), broadcast(0.0F));
    // Two rings from each distance of at least 4 m to its double: the exponent of its square
    const Ints ring = floor_log2(truncate(min(x * x + y * y, broadcast(1e9F)) * 0.0625F) + 1);
    const Ints sector = truncate(pseudo_angle(low_x + high_x, low_y + high_y) * static_cast<float>(sectors));
    store(ring * broadcast(sectors) + (sector & (sectors - 1)), bins_of_facets + number * lane_count);
  }
}

// --- What they hide
// -----------------------------------------------------------------------------------------------------------------

/// What is nearer than least_distance_m counts as behind the
/// eye; a section that passes over the eye hides all above its other end, and one that passes under it all below. Nothing is said
/// of sections that are not between the slopes `from` and `to`.
FARLOD_LANES HiddenSlopes section_of(const Batch& facets, std::size_t lane, const GapEyes& eyes, const Floats& from,
                                     const Floats& to) {
  const HiddenSlopes nothing{broadcast(infinite), broadcast(infinite)};
  Corner corners[3];
  find_corners(facets, lane, eyes, corners);
  Cut cut;
  if (!find_cut(corners, cut)) return nothing;
  const Meeting &m = cut.m, &n = cut.n;
  const Floats m_ahead = m.ahead - least_distance_m * m.weight, n_ahead = n.ahead - least_distance_m * n.weight;
  // Most sections are hidden already, or behind the eye: no division tells
  const Floats nearer = min(m_ahead, n_ahead), farther = max(m_ahead, n_ahead);
  const Floats above_from = max(m.up - from * m.ahead, n.up - from * n.ahead),
               below_to = max(to * m.ahead - m.up, to * n.ahead - n.up);
  const Floats inside = choose(nearer > 0.0F, min(above_from, below_to), farther);
  const Mask is_inside = choose(cut.is_cut, inside, broadcast(-1.0F)) > 0.0F;
  if (bits_of(is_inside) == 0) return nothing;
  const Floats m_slope = m.up / m.ahead, n_slope = n.up / n.ahead;
  // Over or under the eye: the sign of (up_m ahead_n − up_n ahead_m) where n is in front. What touches the eye is under it: up to
  // least_distance_m above
  const Mask n_in_front = n_ahead > 0.0F;
  const Floats front_slope = choose(n_in_front, n_slope, m_slope);
  const Floats m_up = m.up - least_distance_m * m.weight, n_up = n.up - least_distance_m * n.weight;
  const Mask is_over = choose(n_in_front, m_up * n.ahead - n_up * m.ahead, n_up * m.ahead - m_up * n.ahead) > 0.0F;
  const Mask is_past = nearer <= 0.0F;
  const Floats past_low = choose(is_over, front_slope, broadcast(0.0F)),
               past_high = choose(is_over, broadcast(infinite), front_slope);
  return {choose(is_inside, choose(is_past, past_low, min(m_slope, n_slope)), nothing.low),
          choose(is_past, past_high, max(m_slope, n_slope))};
}

// What is stored in `room` is not seen here. NOLINTNEXTLINE(readability-non-const-parameter)
void find_open(const FacetsInBoxes& facets, bool is_solid, float* room, GapBlock& gaps) {
  const GapEyes eyes(gaps.eyes);
  NarrowingGaps left{load(gaps.from.data()), load(gaps.to.data()), room};
  left.hide({load(gaps.hidden_from.data()), load(gaps.hidden_to.data())});
  WedgeOfGaps wedge({gaps.eyes.cosine[0], gaps.eyes.sine[0]}, {gaps.eyes.cosine[lane_count - 1], gaps.eyes.sine[lane_count - 1]},
                    eyes);
  visit_met(
      facets, wedge, [&] { return wedge.set_slopes(left.from, left.to); },
      [&](const Batch& batch, std::size_t lane) { left.hide(section_of(batch, lane, eyes, left.from, left.to)); });
  const Floats outward = load(gaps.eyes.normal_x.data()) * eyes.cosine + load(gaps.eyes.normal_y.data()) * eyes.sine;
  const Open open = open_of(left, SkyOfGaps(outward, load(gaps.eyes.normal_z.data()), is_solid));
  store(open.sky, gaps.sky.data());
  store(open.from, gaps.from.data());
  store(open.to, gaps.to.data());
  store(open.split, gaps.is_split.data());
}

}  // namespace

namespace FARLOD_TARGET {
extern const GapKernels gap_kernels;
constexpr GapKernels gap_kernels{
    .find_gaps = find_gaps, .find_lowest = find_lowest, .find_above = find_above, .find_bins = find_bins, .find_open = find_open};
}  // namespace FARLOD_TARGET

}  // namespace farlod
