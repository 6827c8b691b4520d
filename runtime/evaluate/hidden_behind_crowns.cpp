// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/hidden_behind_crowns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/cancellation.hpp"
#include "horizon/kernels.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

using Row = PacketHorizon::Row;

/// Parts of the sin² below the sky at an azimuth, a ray in the middle of each; and azimuths from one with a ray of some part to
/// the next. An azimuth has a ray in two of its parts, so that 320 azimuths have 640 rays.
constexpr std::size_t parts = 8, azimuths_between = 4, layers = parts / azimuths_between;
/// Above it is nothing that counts, and it is finite.
constexpr float steepest_row = 1e6F;

/// The slope below which this share of the sin² lies that is below the sky: with sin² = t²/(1 + t²), its square is
/// share · t² / (1 + (1 − share) t²).
Row slopes_at(float share, const Row& sky_from) {
  Row slopes;
  for (std::size_t l = 0; l < packet_lanes; ++l) {
    const float slope = std::min(sky_from[l], steepest_row);
    slopes[l] = slope * std::sqrt(share / (1.0F + (1.0F - share) * slope * slope));
  }
  return slopes;
}

/// A part below the sky at each azimuth: the parts go round with the azimuths.
class Layer {
 public:
  Layer(std::size_t layer, const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths)
      : profile_(profile), middles_(azimuths.size()), view_(azimuths.size()) {
    std::vector<Row> from(azimuths.size()), to(azimuths.size());
    for (std::size_t k = 0; k < azimuths.size(); ++k) {
      const auto part = static_cast<float>(layer * azimuths_between + k % azimuths_between);
      from[k] = slopes_at(part / parts, profile.sky_from[k]);
      middles_[k] = slopes_at((part + 0.5F) / parts, profile.sky_from[k]);
      to[k] = slopes_at((part + 1.0F) / parts, profile.sky_from[k]);
    }
    sky_kernels().find_sky_between(from.front().data(), to.front().data(), receivers, azimuths.view(), false,
                                   view_.front().data());
  }

  [[nodiscard]] const Row& slopes(std::size_t azimuth) const { return middles_[azimuth]; }
  /// The share of the view that the part has at an azimuth.
  [[nodiscard]] const Row& view(std::size_t azimuth) const { return view_[azimuth]; }
  /// Bits of the receivers that see the part.
  [[nodiscard]] std::uint32_t seen(std::size_t azimuth) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < packet_lanes; ++l) bits |= view_[azimuth][l] > 0.0F ? 1U << l : 0U;
    return bits;
  }
  /// Bits of the receivers that may see sky there, below an overhang.
  [[nodiscard]] std::uint32_t in_gap(std::size_t azimuth) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < packet_lanes && !profile_.gap_share.empty(); ++l)
      if (profile_.gap_from[azimuth][l] < middles_[azimuth][l] && middles_[azimuth][l] < profile_.gap_to[azimuth][l])
        bits |= 1U << l;
    return bits;
  }

 private:
  const SkyProfile& profile_;
  std::vector<Row> middles_, view_;
};

/// Bits of the rays that meet a crown first, of those that meet something solid. What is solid comes first, since it ends most
/// rays after some metres, and crowns are asked for no farther.
std::uint32_t meet_crown_first(const CanopyScene& scene, const RayOrigins& origins, const Occluder::Directions& directions,
                               std::uint32_t wanted, std::uint32_t in_gap) {
  const Occluder::Distances ends = scene.solid.distances(origins, directions, least_distance_m, wanted);
  std::uint32_t open = 0;
  for (std::size_t l = 0; l < packet_lanes; ++l) open |= ends[l] == std::numeric_limits<float>::infinity() ? 1U << l : 0U;
  return scene.crowns.met_before(ends, origins, directions, least_distance_m, wanted & ~(in_gap & open));
}

}  // namespace

void find_hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths,
                               const CanopyScene& scene, const std::stop_token& stop, std::span<Row> hidden) {
  const RayOrigins origins{receivers.x, receivers.y, receivers.z};
  const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << receivers.count) - 1);
  std::ranges::fill(hidden, Row{});
  for (std::size_t n = 0; n < layers; ++n) {
    throw_if_cancelled(stop);
    const Layer layer(n, profile, receivers, azimuths);
    for (std::size_t k = 0; k < azimuths.size(); ++k) {
      const std::uint32_t wanted = all & layer.seen(k);
      if (wanted == 0) continue;
      Occluder::Directions directions;
      directions.x.fill(azimuths.cosine()[k]);
      directions.y.fill(azimuths.sine()[k]);
      directions.z = layer.slopes(k);
      const std::uint32_t first = meet_crown_first(scene, origins, directions, wanted, layer.in_gap(k));
      for (std::size_t l = 0; l < packet_lanes; ++l)
        if ((first >> l & 1U) != 0) hidden[k][l] += static_cast<float>(azimuths_between) * layer.view(k)[l];
    }
  }
}

}  // namespace farlod
