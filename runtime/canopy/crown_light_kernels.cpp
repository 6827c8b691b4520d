// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "canopy/crown_kernels.hpp"
#include "canopy/crown_sections.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

// --- Sections
// --------------------------------------------------------------------------------------------------------------------

/// Keeps the sections of crowns that reach above the ground.
struct KeepSection {
  const SectionRows& rows;

  FARLOD_LANES bool skips(const SeenCrown& seen, std::uint32_t k) const { return seen.max_slope <= rows.lowest_ground[k]; }

  FARLOD_LANES void visit(const SeenCrown& seen, std::uint32_t k, const CutCrown& cut) const {
    if (bits_of(cut.high > max(cut.low, broadcast(0.0F))) == 0) return;
    const std::size_t place = std::size_t{rows.begins[k]} + rows.counts[k]++;
    CrownSection& section = rows.sections[place];
    store(cut.low, section.low.data());
    store(cut.high, section.high.data());
    store(cut.near, section.near.data());
    store(cut.far, section.far.data());
    rows.crowns[place] = seen.crown;
  }
};

void cut(const CrownScene& scene, std::span<const SeenCrown> seen, const SectionRows& rows) {
  const Eyes eyes = eyes_of(*scene.receivers);
  for (const SeenCrown& crown : seen) cut_crown(scene, crown, eyes, KeepSection{rows});
}

/// The sections of one azimuth.
struct Sections {
  const CrownSection* of;
  const std::uint32_t* crowns;
  std::uint32_t count;
};

// --- The depth of crowns at a slope
// -----------------------------------------------------------------------------------------------

/// e^(−x) of 0 ≤ x ≤ 80, within 3e-7 of itself: 2^(−n) e^(−f) with x = n ln 2 + f, |f| ≤ ln 2 / 2, by seven terms of the series.
FARLOD_LANES Floats exp_of_minus(const Floats& x) {
  const Ints n = truncate(x * 1.44269504F + 0.5F);
  // n ln 2 in two parts, of which the first has few bits
  const Floats whole = to_floats(n), f = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;
  Floats p = broadcast(1.0F / 720.0F);
  p = p * f - 1.0F / 120.0F;
  p = p * f + 1.0F / 24.0F;
  p = p * f - 1.0F / 6.0F;
  p = p * f + 0.5F;
  p = p * f - 1.0F;
  p = p * f + 1.0F;
  return p * from_bits((127 - n) << 23);
}

/// A ray of a slope: t, √(1 + t²) and 1 / t.
struct Ray {
  Floats slope, per_plan, inverse;
};

/// The way within a spheroid. In the plan, s from the eye, it is where (s − u)² + (s t − h)² a²/c² ≤ e: s (1 + t² a²/c²) lies
/// between B ∓ √(e (1 + t² a²/c²) − (h − t u)² a²/c²), B = u + t h a²/c². What is behind the eye does not count.
FARLOD_LANES Floats length_in_spheroid(const CrownSection& s, const Floats& h, float flatness, const Ray& ray) {
  const Floats u = load(s.near.data()), aside = h - ray.slope * u, a = 1.0F + ray.slope * ray.slope * flatness;
  const Floats root = sqrt(max(load(s.far.data()) * a - aside * aside * flatness, broadcast(0.0F)));
  const Floats b = u + ray.slope * h * flatness, zero = broadcast(0.0F);
  return (max(b + root, zero) - max(b - root, zero)) / a * ray.per_plan;
}

/// The way within a cylinder or a prism: between its sides, and between its bottom and its top.
FARLOD_LANES Floats length_in_upright(const CrownSection& s, const Floats& bottom, const Floats& top, const Ray& ray) {
  const Floats entered = max(max(load(s.near.data()), bottom * ray.inverse), broadcast(0.0F)),
               left = min(load(s.far.data()), top * ray.inverse);
  return max(left - entered, broadcast(0.0F)) * ray.per_plan;
}

// --- The light between the ends of crowns
// -----------------------------------------------------------------------------------------

/// Nodes and weights on [0, 1]: those of Gauss and Legendre in z of y = 3 z² − 2 z³, which makes the square root at which the way
/// in a crown begins and ends smooth.
constexpr std::size_t most_nodes = 8;
struct Quadrature {
  std::size_t nodes;
  float place[most_nodes], weight[most_nodes];
};
constexpr Quadrature few{
    4, {0.0137929115F, 0.254838574F, 0.745161426F, 0.986207088F}, {0.0674258142F, 0.432574186F, 0.432574186F, 0.0674258142F}};
constexpr Quadrature many{
    8,
    {0.00116701694F, 0.0289067093F, 0.142136645F, 0.363967083F, 0.636032917F, 0.857863355F, 0.971093291F, 0.998832983F},
    {0.00590997944F, 0.0609306006F, 0.170299343F, 0.262860077F, 0.262860077F, 0.170299343F, 0.0609306006F, 0.00590997944F}};
/// Segments of more of y have many nodes.
constexpr float wide_segment = 0.05F;

/// y = sin²θ of a slope, and the slope; kept off 0 and off the zenith.
FARLOD_LANES Floats sine_square_of(const Floats& slope) {
  const Floats square = slope * slope;
  return square / (1.0F + square);
}
FARLOD_LANES Floats slope_of_sine_square(const Floats& y) {
  const Floats bounded = min(max(y, broadcast(1e-12F)), broadcast(1.0F - 1e-7F));
  return sqrt(bounded / (1.0F - bounded));
}

/// The ends of crowns at an azimuth, and where an upright crown's way has a bend: a row for each. Returns their number.
FARLOD_LANES std::size_t find_ends(const CrownScene& scene, const Sections& sections, const Eyes& eye, bool with_bends,
                                   float* ends) {
  std::size_t count = 0;
  for (std::uint32_t n = 0; n < sections.count; ++n) {
    const CrownSection& s = sections.of[n];
    // A crown that a receiver does not see has no ends there: both are those of an interval below the level
    const Floats low = load(s.low.data()), high = load(s.high.data());
    const Mask is_seen = high > max(low, broadcast(0.0F));
    store(choose(is_seen, low, broadcast(-1.0F)), ends + count++ * lane_count);
    store(choose(is_seen, high, broadcast(-1.0F)), ends + count++ * lane_count);
    const std::uint32_t crown = sections.crowns[n];
    const CrownBatches::Batch& b = scene.batches[crown / lane_count];
    if (!with_bends || b.shape[crown % lane_count] == CrownShape::spheroid) continue;
    // The slopes of the bottom where it is entered, and of the top where it is left
    const Floats near = max(load(s.near.data()), broadcast(1e-6F)), far = max(load(s.far.data()), broadcast(1e-6F));
    const Floats bottom = (b.bottom[crown % lane_count] - eye.z) / near, top = (b.top[crown % lane_count] - eye.z) / far;
    store(choose(is_seen, bottom, broadcast(-1.0F)), ends + count++ * lane_count);
    store(choose(is_seen, top, broadcast(-1.0F)), ends + count++ * lane_count);
  }
  return count;
}

FARLOD_LANES void sort_ends(float* ends, std::size_t count) {
  for (std::size_t n = 1; n < count; ++n) {
    Floats rising = load(ends + n * lane_count);
    std::size_t place = n;
    for (; place > 0; --place) {
      const Floats before = load(ends + (place - 1) * lane_count);
      if (bits_of(before > rising) == 0) break;
      store(max(before, rising), ends + place * lane_count);
      rising = min(before, rising);
    }
    store(rising, ends + place * lane_count);
  }
}

/// Some slopes of each receiver, between which no crown begins or ends.
struct Segment {
  Floats low, high;
};

/// Where a section is met throughout a segment: not at all, otherwise.
FARLOD_LANES Mask met_in(const Segment& segment, const CrownSection& s) {
  return min(segment.low - load(s.low.data()), load(s.high.data()) - segment.high) >= 0.0F;
}

/// The mean of 1 − T over a segment, and the number of crowns in it.
struct Dimmed {
  Floats share, crowns;
};

/// Who is told of the slopes that are dimmed.
struct DimmedAt {
  const DimmedTaker& taker;
  std::uint32_t azimuth;
  FARLOD_LANES void tell(const Segment& segment, const Floats& crowns, const Floats& share) const {
    tell_dimmed(taker, azimuth, min(segment.high - segment.low, crowns), segment.low, segment.high, &share);
  }
};

/// The rule `each`: T is the same throughout.
struct LightByNumber {
  static constexpr bool has_bends = false;
  const CrownScene& scene;

  template <class Sky>
  FARLOD_LANES Dimmed dimmed(const Segment& segment, const Sky&, const Sections& sections, const Eyes&,
                             const DimmedAt& at) const {
    Floats depth{}, crowns{};
    for (std::uint32_t n = 0; n < sections.count; ++n) {
      const std::uint32_t crown = sections.crowns[n];
      const Mask is_met = met_in(segment, sections.of[n]);
      const float of_crown = scene.batches[crown / lane_count].optical_depth[crown % lane_count];
      depth += choose(is_met, broadcast(of_crown), broadcast(0.0F));
      crowns += choose(is_met, broadcast(1.0F), broadcast(0.0F));
    }
    const Floats share = 1.0F - exp_of_minus(min(depth, broadcast(opaque_depth)));
    at.tell(segment, crowns, share);
    return {share, crowns};
  }
};

/// The nodes of a segment: rays, their weights, and the optical depth of what they meet.
struct Nodes {
  std::size_t count;
  Ray rays[most_nodes];
  Floats weight[most_nodes], depth[most_nodes];
};

/// The nodes of each receiver are its own, whatever those beside it need: where one needs many, others have nodes without weight.
template <class Sky>
FARLOD_LANES void set_nodes(const Segment& segment, const Sky& sky, Nodes& nodes) {
  const Floats from = sine_square_of(segment.low), width = sine_square_of(segment.high) - from;
  const Mask is_wide = width > wide_segment;
  nodes.count = bits_of(is_wide) != 0 ? many.nodes : few.nodes;
  for (std::size_t n = 0; n < nodes.count; ++n) {
    const Floats place = choose(is_wide, broadcast(many.place[n]), broadcast(few.place[n]));
    const Floats slope = slope_of_sine_square(from + place * width);
    nodes.rays[n] = {slope, sqrt(1.0F + slope * slope), 1.0F / slope};
    nodes.weight[n] = choose(is_wide, broadcast(many.weight[n]), broadcast(few.weight[n])) * sky.density(slope);
    nodes.depth[n] = Floats{};
  }
}

/// Adds κ l of a crown where it is met.
FARLOD_LANES void add_depth(const CrownBatches::Batch& b, std::size_t lane, const CrownSection& s, const Mask& is_met,
                            const Eyes& eye, Nodes& nodes) {
  const float kappa = b.optical_depth[lane], half_height = 0.5F * (b.top[lane] - b.bottom[lane]);
  const Floats per_length = choose(is_met, broadcast(kappa), broadcast(0.0F));
  if (b.shape[lane] == CrownShape::spheroid) {
    const float ratio = b.half_width[lane] / half_height;
    const Floats h = b.bottom[lane] + half_height - eye.z;
    for (std::size_t n = 0; n < nodes.count; ++n)
      nodes.depth[n] += per_length * length_in_spheroid(s, h, ratio * ratio, nodes.rays[n]);
    return;
  }
  const Floats bottom = b.bottom[lane] - eye.z, top = b.top[lane] - eye.z;
  for (std::size_t n = 0; n < nodes.count; ++n) nodes.depth[n] += per_length * length_in_upright(s, bottom, top, nodes.rays[n]);
}

/// The rule `beer`: T varies with the slope.
struct LightByLength {
  static constexpr bool has_bends = true;
  const CrownScene& scene;

  /// Around each node, T counts as that of the node: in a part of sin² as wide as its weight.
  FARLOD_LANES static void tell_nodes(const Segment& segment, const Nodes& nodes, const Floats& crowns, const DimmedAt& at) {
    const Floats begin = sine_square_of(segment.low), width = sine_square_of(segment.high) - begin;
    const Mask is_wide = width > wide_segment;
    Floats passed{}, from = segment.low;
    for (std::size_t n = 0; n < nodes.count; ++n) {
      passed += choose(is_wide, broadcast(many.weight[n]), broadcast(few.weight[n]));
      const Floats to = n + 1 == nodes.count ? segment.high : min(slope_of_sine_square(begin + passed * width), segment.high);
      at.tell({from, to}, crowns, 1.0F - exp_of_minus(min(nodes.depth[n], broadcast(opaque_depth))));
      from = max(from, to);
    }
  }

  template <class Sky>
  FARLOD_LANES Dimmed dimmed(const Segment& segment, const Sky& sky, const Sections& sections, const Eyes& eye,
                             const DimmedAt& at) const {
    Nodes nodes;
    set_nodes(segment, sky, nodes);
    Floats crowns{};
    for (std::uint32_t n = 0; n < sections.count; ++n) {
      // Most crowns of an azimuth are above the segment, or below it, for all receivers
      const Mask is_met = met_in(segment, sections.of[n]);
      if (bits_of(is_met) == 0) continue;
      crowns += choose(is_met, broadcast(1.0F), broadcast(0.0F));
      const std::uint32_t crown = sections.crowns[n];
      add_depth(scene.batches[crown / lane_count], crown % lane_count, sections.of[n], is_met, eye, nodes);
    }
    // The mean is weighted by the density of A, so that a T that does not vary is integrated exactly
    Floats lost{}, weights{};
    for (std::size_t n = 0; n < nodes.count; ++n) {
      weights += nodes.weight[n];
      lost += nodes.weight[n] * (1.0F - exp_of_minus(min(nodes.depth[n], broadcast(opaque_depth))));
    }
    if (at.taker.take != nullptr) tell_nodes(segment, nodes, crowns, at);
    const Mask is_some = weights > 0.0F;
    return {choose(is_some, lost / choose(is_some, weights, broadcast(1.0F)), broadcast(0.0F)), crowns};
  }
};

/// What crowns take from the sky, and the sky behind them.
struct Taken {
  Floats lost, behind;
};

/// A(low) − A(high) times what is dimmed of it.
template <class Sky, class Light>
FARLOD_LANES void add_segment(const SkyWindow& window, const Sky& sky, const Segment& segment, const Sections& sections,
                              const Light& light, const Eyes& eye, const DimmedAt& at, Taken& taken) {
  const Dimmed dimmed = light.dimmed(segment, sky, sections, eye, at);
  const Floats between = window.weight * sky.between(segment.low, segment.high);
  const Floats behind = choose(min(segment.high - segment.low, dimmed.crowns) > 0.0F, between, broadcast(0.0F));
  taken.behind += behind;
  taken.lost += behind * dimmed.share;
}

template <class Sky, class Light>
FARLOD_LANES void add_window(const SkyWindow& window, const Sky& sky, const float* ends, std::size_t count,
                             const Sections& sections, const Light& light, const Eyes& eye, const DimmedAt& at, Taken& taken) {
  Floats low = window.from;
  for (std::size_t n = 0; n < count; ++n) {
    const Floats high = min(max(load(ends + n * lane_count), low), window.to);
    if (bits_of(high > low) == 0) continue;
    add_segment(window, sky, {low, high}, sections, light, eye, at, taken);
    low = high;
  }
}

template <class Sky, class Light>
FARLOD_LANES void sum_light_of(const SkyRows& rows, const CrownScene& scene, const SectionRows& c, const Light& light,
                               float* ends, CrownSums& sums) {
  const Normals normals = normals_of(*scene.receivers);
  const Eyes eye = eyes_of(*scene.receivers);
  Sum lost(nullptr), behind(c.behind);
  for (std::size_t k = 0; k < scene.azimuths.size; ++k) {
    if (c.counts[k] == 0) {
      // 0 counts as a term, since there may be a crown in other packets of the receiver
      lost.add(Floats{});
      behind.add(Floats{});
      continue;
    }
    const Sections sections{c.sections + c.begins[k], c.crowns + c.begins[k], c.counts[k]};
    const std::size_t count = find_ends(scene, sections, eye, Light::has_bends, ends);
    sort_ends(ends, count);
    const Sky sky = sky_at<Sky>(normals, scene.azimuths.cosine[k], scene.azimuths.sine[k]);
    Taken taken{Floats{}, Floats{}};
    const DimmedAt at{c.dimmed, static_cast<std::uint32_t>(k)};
    add_window(window_above(rows, k, sky), sky, ends, count, sections, light, eye, at, taken);
    if (rows.gap_share != nullptr) add_window(window_of_gap(rows, k, sky), sky, ends, count, sections, light, eye, at, taken);
    lost.add(taken.lost);
    behind.add(taken.behind);
  }
  store(lost.total() / static_cast<float>(scene.azimuths.size), sums.lost.data());
  store(behind.total() / static_cast<float>(scene.azimuths.size), sums.behind.data());
}

void sum_light(const SkyRows& rows, const CrownScene& scene, const SectionRows& c, CanopyRule rule, float* room,
               CrownSums& sums) {
  const LightByLength by_length{scene};
  const LightByNumber by_number{scene};
  if (rule == CanopyRule::beer && scene.all_look_up) return sum_light_of<SkyStraightUp>(rows, scene, c, by_length, room, sums);
  if (rule == CanopyRule::beer) return sum_light_of<SkyOfNormals>(rows, scene, c, by_length, room, sums);
  if (scene.all_look_up) return sum_light_of<SkyStraightUp>(rows, scene, c, by_number, room, sums);
  sum_light_of<SkyOfNormals>(rows, scene, c, by_number, room, sums);
}

}  // namespace

namespace FARLOD_TARGET {
extern const CrownLightKernels crown_light_kernels;
constexpr CrownLightKernels crown_light_kernels{.cut = cut, .sum_light = sum_light};
}  // namespace FARLOD_TARGET

}  // namespace farlod
