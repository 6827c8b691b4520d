// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_jumps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "horizon/kernels.hpp"

namespace farlod {
namespace {

/// A place around a receiver: how far its azimuth is from a direction d, as a sine, and its slope.
struct SeenPlace {
  float angle, slope;
};
SeenPlace seen(const Point3f& p, const Point3f& receiver, float cosine, float sine) {
  const float x = p.x - receiver.x, y = p.y - receiver.y, inverse = 1.0F / std::sqrt(x * x + y * y);
  return {(cosine * y - sine * x) * inverse, (p.z - receiver.z) * inverse};
}

}  // namespace

HorizonJumps::SkyAbove HorizonJumps::sky_above(const PacketHorizon& horizon, SkyWeight weight, const ReceiverPacket& receivers,
                                               const BorderEnds& ends, std::span<PacketHorizon::Row> of_azimuths, float least) {
  if (azimuths_.size() < least_azimuths) return {horizon.sky_above(weight, receivers, of_azimuths), {}};
  SkyAbove above{horizon.sky_above(weight, receivers, sky_), {}};
  std::copy_n(sky_.begin(), of_azimuths.size(), of_azimuths.begin());
  for (const SkyJump& jump : horizon.find_jumps(sky_, least, jumps_))
    for (std::uint32_t lanes = jump.receivers; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const Correction correction = correction_of(jump.azimuth, lane, horizon, receivers, ends);
      above.correction[lane] += correction.sky;
      if (!of_azimuths.empty()) of_azimuths[correction.azimuth][lane] += correction.sky;
    }
  for (std::size_t l = 0; l < above.sky.size(); ++l) {
    above.correction[l] /= static_cast<float>(azimuths_.size());
    above.sky[l] = std::clamp(above.sky[l] + above.correction[l], 0.0F, 1.0F);
  }
  return above;
}

HorizonJumps::Correction HorizonJumps::correction_of(std::size_t azimuth, std::size_t lane, const PacketHorizon& horizon,
                                                     const ReceiverPacket& receivers, const BorderEnds& ends) const {
  constexpr float half = 0.5F;
  const std::size_t next = azimuth + 1 < azimuths_.size() ? azimuth + 1 : 0;
  // The higher horizon hides the sky as far as its edge reaches
  const float here = horizon.row(azimuth)[lane], there = horizon.row(next)[lane];
  const bool is_here = here > there;
  const std::size_t higher = is_here ? azimuth : next;
  const std::int32_t number = horizon.edge_number(higher, lane);
  if (number < 0) return {};
  const float share = share_of(higher, is_here ? 1.0F : -1.0F, number, is_here ? there : here,
                               {receivers.x[lane], receivers.y[lane], receivers.z[lane]}, ends);
  // An edge that reaches over the middle hides sky of the other azimuth; one that does not leaves sky of its own
  const bool is_of_here = is_here == (share < half);
  return {((is_here ? share : 1.0F - share) - half) * (sky_[azimuth][lane] - sky_[next][lane]), is_of_here ? azimuth : next};
}

float HorizonJumps::share_of(std::size_t higher, float towards, std::int32_t number, float lower_slope, const Point3f& receiver,
                             const BorderEnds& ends) const {
  constexpr float half = 0.5F;
  const float cosine = azimuths_.cosine()[higher], sine = azimuths_.sine()[higher];
  const float per_angle = towards * static_cast<float>(azimuths_.size()) / (2.0F * std::numbers::pi_v<float>);
  const auto share_at = [&](const SeenPlace& place) { return place.angle * per_angle; };
  // The end of the edge on the side of the other azimuth
  const std::size_t first = 2 * static_cast<std::size_t>(number);
  const float share_a = share_at(seen(ends.end(first).p, receiver, cosine, sine)),
              share_b = share_at(seen(ends.end(first + 1).p, receiver, cosine, sine));
  const std::size_t last = share_b > share_a ? first + 1 : first;
  float share = share_b > share_a ? share_b : share_a;
  if (!(share >= 0.0F && share < 1.0F)) return half;
  // The edges that go on from there
  for (std::size_t n = ends.end(last).next; n != last; n = ends.end(n).next) {
    const SeenPlace other = seen(ends.end(n ^ 1U).p, receiver, cosine, sine);
    const float share_of_other = share_at(other);
    if (other.slope > lower_slope && share_of_other > share && share_of_other <= 1.0F) share = share_of_other;
  }
  return share;
}

}  // namespace farlod
