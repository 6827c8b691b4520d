// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/traced_canopy.hpp"

#include <algorithm>
#include <cstdint>

#include "base/cancellation.hpp"
#include "evaluate/visibility.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Counts of a receiver's rays, and of those in each half of the sky.
struct Count {
  double all = 0.0;
  std::array<double, SkyHalves::count> of_half{};

  void add(SkyHalves::Bits halves) {
    all += 1.0;
    for (std::size_t h = 0; h < SkyHalves::count; ++h)
      if ((halves >> h & 1U) != 0) of_half[h] += 1.0;
  }
  /// Twice the share of the halves.
  [[nodiscard]] std::array<float, SkyHalves::count> shares_of_halves(double share) const {
    std::array<float, SkyHalves::count> shares;
    std::ranges::transform(of_half, shares.begin(), [&](double count) { return static_cast<float>(2.0 * share * count); });
    return shares;
  }
};

/// Sums of a packet over its directions.
struct Sums {
  std::array<double, RayOrigins::lanes> light{};
  std::array<Count, RayOrigins::lanes> sky, building;

  [[nodiscard]] CanopyLoss loss(std::size_t lane, double share) const {
    return {static_cast<float>(share * light[lane]), static_cast<float>(share * sky[lane].all),
            static_cast<float>(share * building[lane].all), sky[lane].shares_of_halves(share),
            building[lane].shares_of_halves(share)};
  }
};

/// Adds what crowns take in one direction.
void add(const CanopyScene& scene, const RayOrigins& origins, const Point3d& direction_d, SkyHalves::Bits halves,
         std::uint32_t wanted, Sums& sums) {
  const Point3f direction = rounded(direction_d);
  const CrownLights light = scene.crowns.light(origins, direction, least_distance_m, wanted);
  if (light.met == 0) return;
  const bool is_hidden_far = scene.far != nullptr && scene.far->blocks(direction_d);
  const std::uint32_t blocked = is_hidden_far ? light.met : scene.solid.blocked(origins, direction, least_distance_m, light.met);
  // What is solid may be nearer than the first crown, or hide its light from behind
  const Occluder::Distances solid = scene.solid.distances(origins, direction, least_distance_m, blocked);
  for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
    if (((light.met >> l) & 1U) == 0) continue;
    if (((blocked >> l) & 1U) == 0) {
      sums.light[l] += 1.0 - static_cast<double>(light.transmitted[l]);
      sums.sky[l].add(halves);
    } else if (light.nearest[l] <= solid[l]) {
      sums.building[l].add(halves);
    }
  }
}

}  // namespace

bool is_crown_first(const Occluder& solid, const RayOrigins& origins, std::size_t lane, const Point3f& direction, float entry) {
  return !solid.blocks({{origins.x[lane], origins.y[lane], origins.z[lane]}, direction, least_distance_m, entry});
}

std::vector<CanopyLoss> trace_canopies(const CanopyScene& scene, std::span<const Point3f> origins, const TracedDirections& traced,
                                       const std::stop_token& stop) {
  std::vector<CanopyLoss> losses;
  const double share = 1.0 / static_cast<double>(traced.ray_count);
  for (std::size_t first = 0; first < origins.size(); first += RayOrigins::lanes) {
    const std::size_t count = std::min(RayOrigins::lanes, origins.size() - first);
    const RayOrigins together = gathered(origins.subspan(first, count));
    const auto wanted = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    Sums sums;
    for (std::size_t k = 0; k < traced.directions.size(); ++k) {
      if (k % directions_between_looks == 0) throw_if_cancelled(stop);
      const SkyHalves::Bits halves = traced.halves.empty() ? SkyHalves::Bits{0} : traced.halves[k];
      add(scene, together, traced.directions[k], halves, wanted, sums);
    }
    for (std::size_t l = 0; l < count; ++l) losses.push_back(sums.loss(l, share));
  }
  return losses;
}

SvfInterval svf_total_of(const SkyOfReceiver& sky, float lost, float most_error) {
  const SvfInterval &svf = sky.svf, &drawn = sky.drawn;
  // What the profile may lack of the sky, or have too much of it, is lost or not
  const float lacking = drawn.high - drawn.estimate, too_much = drawn.estimate - drawn.low;
  const float low = svf.low - lacking, high = svf.high + too_much;
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
