// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/canopy_answers.hpp"

#include <algorithm>
#include <limits>

#include "contract/expects.hpp"
#include "evaluate/hidden_behind_crowns.hpp"
#include "evaluate/quantity_columns.hpp"
#include "occlusion/placed_mesh.hpp"
#include "scene/canopy_around.hpp"
#include "scene/near_scene.hpp"

namespace farlod {
namespace {

float lowest_z(const CellReceivers& cell) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const Receiver& r : cell.receivers) lowest = std::min(lowest, r.p_cell.z);
  return lowest;
}

}  // namespace

void write_canopy_columns(const Quantities& quantities, float svf, const CanopyLoss& loss, std::span<float> values) {
  FARLOD_EXPECTS(values.size() == count_canopy_columns(quantities));
  std::size_t next = 0;
  const auto add = [&](float value) { values[next++] = value; };
  // Both are sampled: crowns hide no more than the sky that there is
  const float behind = std::clamp(loss.sky, 0.0F, svf);
  if (quantities.svf_total) {
    add(std::clamp(svf - loss.light, 0.0F, svf));
    add(1.0F - behind);
  }
  if (quantities.svfaveg) add(1.0F - loss.building);
  if (quantities.directional_vegetation) {
    // What the answer knows better than the azimuths is not known by halves: it goes to opposite ones alike
    for (const float half : loss.sky_of_half) add(1.0F - std::max(0.0F, half + (behind - loss.sky)));
    for (const float half : loss.building_of_half) add(1.0F - half);
  }
  if (quantities.sky_shares) {
    const float vegetation = behind + std::clamp(loss.building, 0.0F, 1.0F - svf);
    add(svf - behind);
    add(vegetation);
    add(1.0F - (svf - behind) - vegetation);
  }
}

void store_traced_canopies(const CellReceivers& cell, const CanopyScene& scene, Point2d scene_from_cell_m,
                           const SkyDirections& directions, const FurtherQuantities& quantities, const SkyAnswers& answers,
                           const std::stop_token& stop) {
  const FurtherQuantities::CanopyColumns columns = quantities.canopy_columns();
  for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
    std::vector<Point3f> origins;
    for (const Receiver& r : group) origins.push_back(placed(r.p_cell, scene_from_cell_m));
    const std::vector<Point3d> facing = directions.facing_as(group.front());
    std::vector<SkyHalves::Bits> halves;
    for (const Point3d& d : facing) halves.push_back(quantities.halves().of(d));
    const std::vector<CanopyLoss> losses = trace_canopies(scene, origins, {facing, halves, directions.ray_count()}, stop);
    for (std::size_t n = 0; n < group.size(); ++n)
      write_canopy_columns(quantities.quantities(), answers.svf[group[n].index], losses[n],
                           answers.further.subspan(group[n].index * quantities.size() + columns.first, columns.count));
  });
}

CanopyAnswers::CanopyAnswers(const PackageReader& package, const CellReceivers& cell, const FurtherQuantities& further)
    : package_(package),
      cell_(cell),
      further_(further),
      crowns_(canopy_around(package, cell.cell, lowest_z(cell))),
      sky_(crowns_, further.quantities().canopy, further.azimuths()) {
  const Quantities& q = further.quantities();
  if (q.directional_vegetation) behind_.resize(further.azimuths().size());
  if (q.svfaveg || q.directional_vegetation || q.sky_shares) hidden_.resize(further.azimuths().size());
}

CanopyAnswers::Losses CanopyAnswers::evaluate(const SkyProfile& profile, const ReceiverPacket& receivers,
                                              const std::stop_token& stop) {
  Losses losses{};
  if (crowns_.empty()) return losses;
  const CanopyShares shares = sky_.evaluate(profile, receivers, behind_);
  for (std::size_t l = 0; l < receivers.count; ++l) losses[l] = {shares.lost[l], shares.behind[l]};
  if (!behind_.empty())
    add_halves(behind_, &CanopyLoss::sky_of_half, 1.0 / static_cast<double>(further_.azimuths().size()), losses);
  if (hidden_.empty()) return losses;
  if (!occluder_) {
    near_.emplace(near_scene(package_, cell_.cell));
    occluder_.emplace(crowns_, further_.quantities().canopy, stop);
  }
  find_hidden_behind_crowns(profile, receivers, further_.azimuths(), {*near_, *occluder_}, stop, hidden_);
  SkyHalves::Sums sums{};
  for (const PacketHorizon::Row& row : hidden_)
    for (std::size_t l = 0; l < receivers.count; ++l) sums[l] += static_cast<double>(row[l]);
  for (std::size_t l = 0; l < receivers.count; ++l) losses[l].building = static_cast<float>(sums[l]);
  if (!behind_.empty()) add_halves(hidden_, &CanopyLoss::building_of_half, 1.0, losses);
  return losses;
}

void CanopyAnswers::add_halves(std::span<const PacketHorizon::Row> terms,
                               std::array<float, SkyHalves::count> CanopyLoss::*of_half, double share, Losses& losses) const {
  const std::array<SkyHalves::Sums, SkyHalves::count> sums = further_.halves().sums(terms);
  for (std::size_t h = 0; h < SkyHalves::count; ++h)
    for (std::size_t l = 0; l < losses.size(); ++l) (losses[l].*of_half)[h] = static_cast<float>(share * sums[h][l]);
}

}  // namespace farlod
