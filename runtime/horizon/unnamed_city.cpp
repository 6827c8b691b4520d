// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/unnamed_city.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace farlod {

UnnamedCity::UnnamedCity(const FarHorizon& map, const AzimuthRing& ring)
    : map_(map), level_(map.bins.count, 0.0F), infinite_(map.bins.count, std::numeric_limits<float>::infinity()) {
  for (std::size_t k = 0; k < ring.size(); ++k) bin_of_azimuth_.push_back(map.bins.bin_of({ring.cosine()[k], ring.sine()[k]}));
}

UnnamedCity::Patch UnnamedCity::patch_of(const ReceiverPacket& r, std::size_t lane) const {
  return map_.patches.patch_of({r.x[lane], r.y[lane], r.z[lane]});
}

UnnamedCity::Patch UnnamedCity::patch_of_all(const ReceiverPacket& r) const {
  const Patch first = patch_of(r, 0);
  for (std::size_t l = 1; l < r.count; ++l)
    if (patch_of(r, l) != first) return std::nullopt;
  return first;
}

void UnnamedCity::raise_lower(const ReceiverPacket& r, PacketHorizon& horizon) const {
  if (const Patch patch = patch_of_all(r)) return horizon.raise_all(lower_row(patch), bin_of_azimuth_);
  for (std::size_t l = 0; l < r.count; ++l) horizon.raise(l, lower_row(patch_of(r, l)), bin_of_azimuth_);
}

void UnnamedCity::raise_upper(const ReceiverPacket& r, PacketHorizon& horizon) const {
  if (const Patch patch = patch_of_all(r)) return horizon.raise_all(upper_row(patch), bin_of_azimuth_);
  for (std::size_t l = 0; l < r.count; ++l) horizon.raise(l, upper_row(patch_of(r, l)), bin_of_azimuth_);
}

void UnnamedCity::raise_likely(const ReceiverPacket& r, PacketHorizon& horizon) const {
  const Patch patch = patch_of_all(r);
  if (!patch) {
    for (std::size_t l = 0; l < r.count; ++l) raise_likely_of(r, l, horizon);
    return;
  }
  PacketHorizon::RowsBetween rows{map_.row(map_.likely, *patch), {}, lower_row(patch), upper_row(patch), {}};
  std::uint32_t above = *patch;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) std::tie(above, rows.shares[l]) = map_.floor_above(*patch, r.z[l]);
  rows.above = map_.row(map_.likely, above);
  horizon.raise(rows, bin_of_azimuth_);
}

/// The same for a receiver by itself.
void UnnamedCity::raise_likely_of(const ReceiverPacket& r, std::size_t lane, PacketHorizon& horizon) const {
  const float lowest_m = map_.patches.levels_m().front();
  const std::uint32_t patch = *map_.patches.patch_of({r.x[lane], r.y[lane], std::max(r.z[lane], lowest_m)});
  const auto [above, share] = map_.floor_above(patch, r.z[lane]);
  const std::span<const float> here_row = map_.row(map_.likely, patch), above_row = map_.row(map_.likely, above);
  std::vector<float> likely(here_row.size());
  for (std::size_t bin = 0; bin < likely.size(); ++bin) {
    const float between = here_row[bin] + share * (above_row[bin] - here_row[bin]);
    likely[bin] = std::clamp(between, lower_row(patch)[bin], upper_row(patch)[bin]);
  }
  horizon.raise(lane, likely, bin_of_azimuth_);
}

}  // namespace farlod
