// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include "farlod/expects.hpp"

namespace farlod {

HorizonEngine::HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSkyline& skyline,
                             const HangingCity& hanging)
    : weight_(weight), skyline_(skyline), hanging_(hanging), unnamed_(far, ring), horizon_(ring), outlines_(ring) {}

std::uint32_t HorizonEngine::evaluate(const ReceiverPacket& receivers, std::span<BoundedShare> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  horizon_.clear();
  // What hides much first: what lies below is passed over
  unnamed_.raise_likely(receivers, horizon_);
  horizon_.raise(skyline_.standing, receivers);
  const PacketHorizon::Lanes sky = horizon_.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) shares[l] = {sky[l], sky[l], sky[l]};
  return see_hanging(receivers);
}

std::uint32_t HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, std::span<BoundedShare> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  horizon_.clear();
  // From the lowest horizon to the highest, each raised from the one before
  unnamed_.raise_lower(receivers, horizon_);
  horizon_.raise(skyline_.standing, receivers);
  const PacketHorizon::Lanes high = horizon_.sky_above(weight_, receivers);
  const std::uint32_t seen = see_hanging(receivers);
  unnamed_.raise_likely(receivers, horizon_);
  const PacketHorizon::Lanes likely = horizon_.sky_above(weight_, receivers);
  unnamed_.raise_upper(receivers, horizon_);
  const PacketHorizon::Lanes low = horizon_.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) shares[l] = {low[l], likely[l], high[l]};
  return seen;
}

std::uint32_t HorizonEngine::see_hanging(const ReceiverPacket& receivers) {
  if (hanging_.empty()) return 0;
  outlines_.clear();
  hanging_.raise(receivers, outlines_);
  return hanging_.covered(receivers) | outlines_.above(horizon_);
}

}  // namespace farlod
