// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/svf_total.hpp"

#include <algorithm>

#include "evaluate/visibility.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {

SvfInterval svf_total_of(const SkyOfReceiver& sky, float lost, float most_error) {
  const SvfInterval &svf = sky.svf, &drawn = sky.drawn;
  // What the profile may lack of the sky, or have too much of it, is lost or not
  const float lacking = drawn.high - drawn.estimate, too_much = drawn.estimate - drawn.low;
  float low = svf.low - lacking, high = svf.high + too_much;
  if (sky.is_drawn) low = std::max(low, drawn.low), high = std::min(high, drawn.high);
  SvfInterval total;
  total.low = std::clamp(low - lost - most_error, 0.0F, svf.high);
  total.high = std::clamp(high - lost + most_error, total.low, svf.high);
  total.estimate = std::clamp(svf.estimate - lost, total.low, total.high);
  // No more than all of it, also where the two are moved towards the middle
  total.estimate = std::clamp(total.estimate, 0.0F, svf.estimate);
  return total;
}

std::vector<float> trace_svf_totals(const CanopyScene& city, Point2d scene_from_cell_m, const SkyDirections& directions,
                                    std::span<const Receiver> receivers, const std::stop_token& stop) {
  std::vector<float> totals;
  const double share = 1.0 / static_cast<double>(directions.ray_count());
  for_each_normal(receivers, [&](std::span<const Receiver> group) {
    std::vector<Point3f> origins;
    for (const Receiver& r : group) origins.push_back(placed(r.p_cell, scene_from_cell_m));
    const std::vector<Point3d> facing = directions.facing_as(group.front());
    const std::vector<std::uint32_t> free = count_free(city.solid, origins, facing, stop);
    const std::vector<CanopyLoss> losses = trace_canopies(city, origins, {facing, {}, directions.ray_count()}, stop);
    for (std::size_t n = 0; n < group.size(); ++n)
      totals.push_back(std::max(0.0F, static_cast<float>(share * free[n]) - losses[n].light));
  });
  return totals;
}

}  // namespace farlod
