// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/overhang_horizons.hpp"

#include <algorithm>

namespace farlod {
namespace {

ReceiverBox box_around(const ReceiverPacket& r) {
  const auto [west, east] = std::minmax_element(r.x.begin(), r.x.end());
  const auto [south, north] = std::minmax_element(r.y.begin(), r.y.end());
  const auto [bottom, top] = std::minmax_element(r.z.begin(), r.z.end());
  return {{*west, *south, *bottom}, {*east, *north, *top}};
}

/// Lower borders are many where balconies are, and most face away from a few neighbouring receivers.
SkylineEdges facing(const SkylineEdges& lower, const ReceiverBox& box) {
  return lower.empty() ? SkylineEdges() : lower.facing(box, EdgeRole::underside);
}

}  // namespace

void OverhangHorizons::draw_overhangs(const CellSkyline& skyline, const ReceiverPacket& receivers, std::uint32_t covered,
                                      FarGaps far_gaps) {
  const ReceiverBox box = box_around(receivers);
  const SkylineEdges far_lower = facing(skyline.far.lower, box), near_lower = facing(skyline.near.lower, box);
  // The far city by itself: where nothing of it is seen to float, it goes on below what is near
  upper.raise(skyline.far.upper, receivers);
  if (far_gaps == FarGaps::likely && !far_lower.empty())
    borders.become_lowest(far_lower, receivers, grounded);
  else
    borders.raise(far_lower, receivers);
  grounded.join(borders, upper);
  far_borders = borders;
  far_upper = upper;
  // Then what is near
  borders.raise_to(grounded);
  upper.raise(skyline.near.upper, receivers);
  upper.close(covered);
  borders.raise(near_lower, receivers);
}

std::span<const PacketHorizon::Row> OverhangHorizons::find_sky_below_borders(SkyWeight weight, const ReceiverPacket& receivers,
                                                                             std::vector<PacketHorizon::Row>& rows) {
  if (borders.above(grounded) == 0) return {};
  borders.lower_to(upper);
  grounded.find_sky_below(borders, weight, receivers, rows);
  // What is far may fill a part of it
  far_borders.raise_to(grounded);
  far_upper.lower_to(borders);
  far_upper.raise_to(far_borders);
  if (far_upper.above(far_borders) == 0) return rows;
  far_borders.find_sky_below(far_upper, weight, receivers, filled_);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t l = 0; l < rows[k].size(); ++l) rows[k][l] = std::max(0.0F, rows[k][l] - filled_[k][l]);
  return rows;
}

}  // namespace farlod
