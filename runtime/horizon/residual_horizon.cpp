// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/residual_horizon.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace farlod {
namespace {

/// Calls `raise(patch, caps)` once for each patch that receivers are in (`patch_of(lane)`), with caps that raise the horizons of
/// the receivers in it alone (PacketHorizon::raise).
template <class PatchOf, class Raise>
void for_each_patch(const PatchOf& patch_of, const Raise& raise) {
  std::array<std::optional<std::uint32_t>, ReceiverPacket::lanes> patches;
  for (std::size_t l = 0; l < patches.size(); ++l) patches[l] = patch_of(l);
  for (std::size_t first = 0; first < patches.size(); ++first) {
    const auto patch = patches[first];
    const auto before = std::span(patches).first(first);
    if (std::find(before.begin(), before.end(), patch) != before.end()) continue;
    PacketHorizon::Lanes caps;
    for (std::size_t l = 0; l < patches.size(); ++l)
      caps[l] = patches[l] == patch ? std::numeric_limits<float>::infinity() : 0.0F;
    raise(patch, caps);
  }
}

}  // namespace

ResidualHorizon::ResidualHorizon(const FarHorizon& map, const AzimuthSampling& azimuths)
    : map_(map),
      is_grounded_(std::all_of(map.overhang.begin(), map.overhang.end(), [](float slope) { return slope == 0.0F; })),
      level_(map.bins.count, 0.0F),
      infinite_(map.bins.count, std::numeric_limits<float>::infinity()) {
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    bin_of_azimuth_.push_back(map.bins.bin_of({azimuths.cosine()[k], azimuths.sine()[k]}));
}

ResidualHorizon::Patch ResidualHorizon::patch_of(const ReceiverPacket& r, std::size_t lane) const {
  return map_.patches.patch_of({r.x[lane], r.y[lane], r.z[lane]});
}

ResidualHorizon::Patch ResidualHorizon::patch_or_lowest(const ReceiverPacket& r, std::size_t lane) const {
  return map_.patches.patch_of({r.x[lane], r.y[lane], std::max(r.z[lane], map_.patches.levels_m().front())});
}

void ResidualHorizon::raise_to_low(const ReceiverPacket& r, PacketHorizon& horizon) const {
  for_each_patch([&](std::size_t lane) { return patch_of(r, lane); },
                 [&](Patch patch, const PacketHorizon::Lanes& caps) { horizon.raise(low_row(patch), caps, bin_of_azimuth_); });
}

void ResidualHorizon::raise_to_high(const ReceiverPacket& r, PacketHorizon& horizon) const {
  for_each_patch([&](std::size_t lane) { return patch_of(r, lane); },
                 [&](Patch patch, const PacketHorizon::Lanes& caps) { horizon.raise(high_row(patch), caps, bin_of_azimuth_); });
}

void ResidualHorizon::find_in_wedges(const ReceiverPacket& r, InWedges& rows) const {
  std::array<Patch, ReceiverPacket::lanes> patches;
  for (std::size_t l = 0; l < patches.size(); ++l) patches[l] = patch_of(r, l);
  const std::size_t count = bin_of_azimuth_.size();
  if (rows.least.size() == count && rows.patches == patches) return;
  rows.patches = patches;
  for (auto* all : {&rows.least, &rows.most, &rows.overhang}) all->resize(count);
  const auto lower = [](float a, float b) { return std::min(a, b); };
  const auto higher = [](float a, float b) { return std::max(a, b); };
  for_each_patch([&](std::size_t lane) { return patches[lane]; },
                 [&](Patch patch, const PacketHorizon::Lanes& caps) {
                   fill_wedges(low_row(patch), caps, lower, rows.least);
                   fill_wedges(high_row(patch), caps, higher, rows.most);
                   fill_wedges(overhang_row(patch), caps, higher, rows.overhang);
                 });
  rows.overhang_below_low = rows.overhang;
  rows.reached_below_low.assign(count, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      float& border = rows.overhang_below_low[k][l];
      border = std::min(border, rows.least[k][l]);
      if (border > 0.0F) rows.reached_below_low[k] = 1;
    }
}

template <class Choose>
void ResidualHorizon::fill_wedges(std::span<const float> row, const PacketHorizon::Lanes& caps, const Choose& choose,
                                  std::vector<PacketHorizon::Row>& wedges) const {
  for (std::size_t k = 0; k < wedges.size(); ++k) {
    std::uint32_t bin = bin_of_azimuth_[k];
    const std::uint32_t last = bin_of_azimuth_[k + 1 < wedges.size() ? k + 1 : 0];
    float chosen = row[bin];
    while (bin != last) {
      bin = bin + 1 < row.size() ? bin + 1 : 0;
      chosen = choose(chosen, row[bin]);
    }
    for (std::size_t l = 0; l < caps.size(); ++l)
      if (caps[l] > 0.0F) wedges[k][l] = chosen;
  }
}

void ResidualHorizon::raise_to_overhang(const ReceiverPacket& r, PacketHorizon& horizon) const {
  if (is_grounded_) return;
  for_each_patch(
      [&](std::size_t lane) { return patch_of(r, lane); },
      [&](Patch patch, const PacketHorizon::Lanes& caps) { horizon.raise(overhang_row(patch), caps, bin_of_azimuth_); });
}

void ResidualHorizon::raise_to_estimate(const ReceiverPacket& r, PacketHorizon& horizon) const {
  // Interpolate between the level of the patch and the next one above, each receiver at its own height
  const auto raise = [&](Patch patch, const PacketHorizon::Lanes& caps) {
    ResidualRows rows{map_.row(map_.estimate, *patch), {}, low_row(patch), high_row(patch), {}, caps};
    std::uint32_t above = *patch;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) std::tie(above, rows.shares[l]) = map_.floor_above(*patch, r.z[l]);
    rows.above = map_.row(map_.estimate, above);
    horizon.raise(rows, bin_of_azimuth_);
  };
  for_each_patch([&](std::size_t lane) { return patch_or_lowest(r, lane); }, raise);
}

}  // namespace farlod
