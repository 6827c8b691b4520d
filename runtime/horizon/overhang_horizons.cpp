// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/overhang_horizons.hpp"

#include <algorithm>

namespace farlod {
void OverhangHorizons::draw_overhangs(const CellSilhouettes& silhouettes, const ReceiverPacket& receivers, std::uint32_t covered,
                                      FarGaps far_gaps) {
  // The far city by itself: where nothing of it is seen to float, it goes on below what is near
  upper.raise(silhouettes.far.overhangs, receivers);
  if (far_gaps == FarGaps::estimate && !silhouettes.far.undersides.empty())
    borders.become_lowest(silhouettes.far.undersides, receivers, grounded);
  else
    borders.raise(silhouettes.far.undersides, receivers);
  grounded.join(borders, upper);
  far_borders = borders;
  far_upper = upper;
  // Then what is near
  borders.raise_to(grounded);
  upper.raise(silhouettes.near.overhangs, receivers);
  upper.close(covered);
  borders.raise(silhouettes.near.undersides, receivers);
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
