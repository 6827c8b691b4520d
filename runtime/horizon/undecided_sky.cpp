// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/undecided_sky.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/cancellation.hpp"
#include "horizon/gap_rays.hpp"

namespace farlod {
namespace {}  // namespace

void UndecidedSky::measure(const PacketHorizon& estimate, SkyWeight weight, const ReceiverPacket& receivers) {
  from.find_sky_below(to, weight, receivers, most_);
  estimate.find_sky_below(to, weight, receivers, expected_);
  gaps_.assign(azimuths_.size(), 0);
}

void UndecidedSky::add_gaps(std::span<const Row> most, std::span<const Row> estimate, const PacketHorizon& grounded) {
  for (std::size_t k = 0; k < most.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      if (most[k][l] <= 0.0F) continue;
      gaps_[k] |= 1U << l;
      most_[k][l] += most[k][l];
      if (!estimate.empty()) expected_[k][l] += std::min(0.5F * estimate[k][l], most[k][l]);
      from.lower(k, l, grounded.row(k)[l]);
    }
}

void UndecidedSky::mark_gaps(const PacketHorizon& overhangs) {
  for (std::size_t k = 0; k < most_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (most_[k][l] > 0.0F && overhangs.row(k)[l] > from.row(k)[l]) gaps_[k] |= 1U << l;
}

/// Intervals by octaves of their width: the octave c holds those of [2^−c, 2^(1−c)) times the widest, and 0 the widest.
class UndecidedSky::Octaves {
 public:
  Octaves(const UndecidedSky& sky, std::size_t lane) {
    for (const Row& row : sky.most_) widest_ = std::max(widest_, row[lane]);
    for (std::size_t k = 0; k < sky.most_.size(); ++k) {
      const float width = sky.most_[k][lane];
      if (width > 0.0F) (sky.is_gap(k, lane) ? gaps_ : halved_)[static_cast<std::size_t>(octave_of(width))] += width;
    }
  }
  /// At most `most_halvings`.
  [[nodiscard]] int octave_of(float width) const {
    int exponent = 0;
    (void)std::frexp(static_cast<double>(width) / static_cast<double>(widest_), &exponent);
    return std::min(1 - exponent, most_halvings);
  }
  /// What is undecided after all that is wider than this octave is halved down to it, and gaps that are wider are traced.
  [[nodiscard]] double left_at(int level) const {
    double left = 0.0;
    for (int c = 0; c <= most_halvings; ++c) {
      const auto octave = static_cast<std::size_t>(c);
      left += std::ldexp(halved_[octave], std::min(0, c - level)) + (c < level ? 0.0 : gaps_[octave]);
    }
    return left;
  }

 private:
  float widest_ = 0.0F;
  std::array<double, most_halvings + 1> halved_{}, gaps_{};
};

int UndecidedSky::plan(std::size_t lane, double max_width) {
  const Octaves octaves(*this, lane);
  int level = 0;
  while (level < most_halvings && octaves.left_at(level) > max_width) ++level;
  if (level == 0) return level;
  // Not all of the last halvings are needed
  double excess = octaves.left_at(level - 1) - max_width;
  for (std::size_t k = 0; k < most_.size(); ++k) {
    const float width = most_[k][lane];
    const int halvings = width > 0.0F ? level - octaves.octave_of(width) : 0;
    if (halvings <= 0) continue;
    const bool is_traced_anyway = is_gap(k, lane) && halvings > 1;
    const bool is_needed = is_traced_anyway || excess > 0.0;
    plan_[k][lane] = static_cast<std::uint8_t>(is_needed ? halvings : halvings - 1);
    if (is_needed && !is_traced_anyway) excess -= is_gap(k, lane) ? width : std::ldexp(static_cast<double>(width), -halvings);
  }
  return level;
}

struct UndecidedSky::Tracing {
  const Wanted& wanted;
  const PlacedScene& city;
  SkyWeight weight;
  const ReceiverPacket& receivers;
  RayOrigins origins;
};

UndecidedSky::Decided UndecidedSky::decide(const Wanted& wanted, const PlacedScene& city, SkyWeight weight,
                                           const ReceiverPacket& receivers) {
  Decided decided;
  plan_.assign(azimuths_.size(), {});
  std::uint32_t closed = 0;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
    if (has_bit(wanted.receivers, l) && plan(l, wanted.max_width) == most_halvings) closed |= 1U << l;
  const Tracing tracing{wanted, city, weight, receivers, origins_of(receivers, city.scene_from_cell_m)};
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    if (halved_at(k, 0) != 0) halve(k, tracing, decided);
  trace_gaps(tracing, decided);
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      decided.expected[l] += expected_[k][l];
      if (!has_bit(closed, l)) decided.width[l] += most_[k][l];
    }
  return decided;
}

std::uint32_t UndecidedSky::halved_at(std::size_t azimuth, int step) const {
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) bits |= plan_[azimuth][l] > step && !is_gap(azimuth, l) ? 1U << l : 0U;
  return bits;
}

void UndecidedSky::halve(std::size_t azimuth, const Tracing& tracing, Decided& decided) {
  throw_if_cancelled(tracing.wanted.stop);
  const SkyKernels& kernels = sky_kernels();
  const GapAzimuth direction{azimuths_.cosine()[azimuth], azimuths_.sine()[azimuth], tracing.weight == SkyWeight::solid_angle};
  Row low = from.row(azimuth), high = to.row(azimuth);
  GapEnds ends;
  kernels.find_gap_ends(low.data(), high.data(), tracing.receivers, direction, ends);
  const Lanes above_all = ends.sky_to;
  Occluder::Directions directions;
  directions.x.fill(direction.cosine);
  directions.y.fill(direction.sine);
  int step = 0;
  for (std::uint32_t asked = halved_at(azimuth, step); asked != 0; asked = halved_at(azimuth, ++step)) {
    // All below a ray that meets something is hidden, all above one that meets nothing is sky
    kernels.find_gap_slopes(ends, tracing.receivers, direction, 0.5F, directions.z.data());
    const std::uint32_t hidden = tracing.city.occluder.blocked(tracing.origins, directions, least_distance_m, asked);
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (has_bit(asked, l)) (has_bit(hidden, l) ? low : high)[l] = directions.z[l];
    kernels.find_gap_ends(low.data(), high.data(), tracing.receivers, direction, ends);
    decided.rays += static_cast<std::uint64_t>(std::popcount(asked));
  }
  store_halved(azimuth, above_all, ends, decided);
}

void UndecidedSky::store_halved(std::size_t azimuth, const Lanes& above_all, const GapEnds& ends, Decided& decided) {
  const float share = 1.0F / static_cast<float>(azimuths_.size());
  for (std::uint32_t bits = halved_at(azimuth, 0); bits != 0; bits &= bits - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(bits));
    const float seen = std::max(0.0F, ends.sky_to[l] - above_all[l]) * share;
    const float width = std::max(0.0F, ends.sky_from[l] - ends.sky_to[l]) * share;
    decided.seen[l] += static_cast<double>(seen);
    most_[azimuth][l] = width;
    expected_[azimuth][l] = std::clamp(expected_[azimuth][l] - seen, 0.0F, width);
  }
}

void UndecidedSky::trace_gaps(const Tracing& tracing, Decided& decided) {
  // The sky of the intervals that are traced: what is hidden for certain between a gap and the upper borders is hidden from rays
  from.find_sky_below(to, tracing.weight, tracing.receivers, gap_sky_);
  std::array<double, ReceiverPacket::lanes> most{}, traced{};
  std::uint32_t wanted = 0;
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      if (!is_gap(k, l) || plan_[k][l] == 0) {
        gap_sky_[k][l] = 0.0F;
        continue;
      }
      wanted |= 1U << l;
      traced[l] += gap_sky_[k][l];
      most[l] += std::exchange(most_[k][l], 0.0F);
      expected_[k][l] = 0.0F;
    }
  if (wanted == 0) return;
  // The error of n rays in a part of the sky is that part times c n^(−3/4), instead of c N^(−3/4) for N rays in all of it: they
  // keep it if n/N is the part's power of 4/3
  const double part = *std::max_element(traced.begin(), traced.end());
  const double rays_per_azimuth =
      std::ceil(static_cast<double>(tracing.wanted.rays_per_azimuth) * std::min(1.0, std::cbrt(part)));
  const SeenInGaps seen = farlod::trace_gaps({from, to, to, to, gap_sky_}, azimuths_, tracing.weight, tracing.receivers, wanted,
                                             static_cast<std::size_t>(rays_per_azimuth), tracing.city, tracing.wanted.stop);
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) decided.seen[l] += std::min(static_cast<double>(seen.sky[l]), most[l]);
  decided.rays += seen.rays;
}

}  // namespace farlod
