// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/hidden_behind_crowns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contract/cancellation.hpp"
#include "horizon/kernels.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

using Row = PacketHorizon::Row;
constexpr std::size_t lanes = ReceiverPacket::lanes;

/// Parts of the sin² below the sky at an azimuth, a ray in the middle of each; and azimuths from one with a ray of some part to
/// the next. 320 azimuths have 640 rays.
constexpr std::size_t parts = 8, azimuths_between = 4;
/// Above it is nothing that counts, and it is finite.
constexpr float straight_up = 1e6F;

/// The slope below which this share of the sin² lies that is below the sky.
Row slopes_at(double share, const Row& sky_from) {
  Row slopes;
  for (std::size_t l = 0; l < lanes; ++l) {
    const double slope = std::min(sky_from[l], straight_up), square = slope * slope, part = share * square / (1.0 + square);
    slopes[l] = static_cast<float>(std::min(std::sqrt(part / (1.0 - part)), static_cast<double>(straight_up)));
  }
  return slopes;
}

/// A part below the sky of all azimuths.
class PartBelowSky {
 public:
  PartBelowSky(std::size_t part, const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths)
      : profile_(profile), middle_((static_cast<double>(part) + 0.5) / parts), view_(azimuths.size()) {
    std::vector<Row> from, to;
    for (const Row& sky : profile.sky_from) {
      from.push_back(slopes_at(static_cast<double>(part) / parts, sky));
      to.push_back(slopes_at(static_cast<double>(part + 1) / parts, sky));
    }
    sky_kernels().find_sky_between(from.front().data(), to.front().data(), receivers, azimuths.view(), false,
                                   view_.front().data());
  }

  [[nodiscard]] Row slopes(std::size_t azimuth) const { return slopes_at(middle_, profile_.sky_from[azimuth]); }
  /// The share of the view that the part has at an azimuth.
  [[nodiscard]] const Row& view(std::size_t azimuth) const { return view_[azimuth]; }
  /// Bits of the receivers that may see sky there, below an overhang.
  [[nodiscard]] std::uint32_t in_gap(std::size_t azimuth, const Row& slope) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < lanes && !profile_.gap_share.empty(); ++l)
      if (profile_.gap_from[azimuth][l] < slope[l] && slope[l] < profile_.gap_to[azimuth][l]) bits |= 1U << l;
    return bits;
  }

 private:
  const SkyProfile& profile_;
  double middle_;
  std::vector<Row> view_;
};

/// Bits of the rays that meet a crown first, of those that meet something solid.
std::uint32_t meet_crown_first(const CanopyScene& scene, const RayOrigins& origins, const Occluder::Directions& directions,
                               std::uint32_t wanted, std::uint32_t in_gap) {
  const CrownLights light = scene.crowns.light(origins, directions, least_distance_m, wanted);
  if (light.met == 0) return 0;
  const std::uint32_t open = in_gap & ~scene.solid.blocked(origins, directions, least_distance_m, light.met);
  std::uint32_t first = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const Point3f direction{directions.x[l], directions.y[l], directions.z[l]};
    if (((light.met & ~open) >> l & 1U) != 0 && is_crown_first(scene.solid, origins, l, direction, light.nearest[l]))
      first |= 1U << l;
  }
  return first;
}

}  // namespace

void find_hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths,
                               const CanopyScene& scene, const std::stop_token& stop, std::span<Row> hidden) {
  const RayOrigins origins{receivers.x, receivers.y, receivers.z};
  const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << receivers.count) - 1);
  std::ranges::fill(hidden, Row{});
  for (std::size_t n = 0; n < parts; ++n) {
    throw_if_cancelled(stop);
    const PartBelowSky part(n, profile, receivers, azimuths);
    for (std::size_t k = n % azimuths_between; k < azimuths.size(); k += azimuths_between) {
      const Row slopes = part.slopes(k);
      Occluder::Directions directions;
      directions.x.fill(azimuths.cosine()[k]);
      directions.y.fill(azimuths.sine()[k]);
      directions.z = slopes;
      const std::uint32_t first = meet_crown_first(scene, origins, directions, all, part.in_gap(k, slopes));
      for (std::size_t l = 0; l < lanes; ++l)
        if ((first >> l & 1U) != 0) hidden[k][l] += static_cast<float>(azimuths_between) * part.view(k)[l];
    }
  }
}

}  // namespace farlod
