// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/surface_views.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/cancellation.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/receiver_packet.hpp"
#include "receivers/receiver.hpp"

namespace farlod {
namespace {

/// Receivers near each other, whose rays go in the same directions.
struct PacketOfSurface {
  RayOrigins origins;
  std::array<double, RayOrigins::lanes> area_m2{};
  std::size_t count = 0;
};

void look_for_columns(const SceneOfColumns& scene, const PacketOfSurface& packet, const Point3d& towards, ColumnSums& sums) {
  const Point3f direction = rounded(towards);
  const auto wanted = static_cast<std::uint32_t>((std::uint64_t{1} << packet.count) - 1);
  const Occluder::Hits hits = scene.solid.nearest(packet.origins, direction, least_distance_m, wanted);
  // As for Quantities::view_factors, crowns hide what is behind them, and the ground goes on where the city ends
  const std::uint32_t crowns = scene.crowns == nullptr
                                   ? 0
                                   : scene.crowns->met_before(hits.distances, packet.origins,
                                                              Occluder::Directions::all_of(direction), least_distance_m, wanted);
  const std::uint32_t beyond = scene.columns.rest(towards.z > 0.0 ? MatrixRest::sky : MatrixRest::ground_beyond);
  for (std::size_t l = 0; l < packet.count; ++l) {
    const bool is_free = hits.distances[l] == std::numeric_limits<float>::infinity();
    const std::uint32_t met = is_free ? beyond : scene.seen.met(hits.triangles[l], direction);
    sums.add(has_bit(crowns, l) ? scene.columns.rest(MatrixRest::crown) : met, packet.area_m2[l]);
  }
}

/// Receivers near each other one after the other; the index tells which each is.
std::vector<Receiver> in_order_on_surface(std::span<const ReceiverInScene> receivers, const std::stop_token& stop) {
  std::vector<Receiver> given, ordered;
  for (std::size_t n = 0; n < receivers.size(); ++n) given.push_back({n, receivers[n].p_scene, receivers[n].normal});
  for (const std::uint32_t n : packet_order(given, stop).numbers) ordered.push_back(given[n]);
  return ordered;
}

PacketOfSurface packet_of(std::span<const Receiver> together, std::span<const ReceiverInScene> receivers) {
  std::vector<Point3f> places;
  for (const Receiver& r : together) places.push_back(r.p_cell);
  PacketOfSurface packet{gathered(places), {}, together.size()};
  for (std::size_t l = 0; l < together.size(); ++l) packet.area_m2[l] = static_cast<double>(receivers[together[l].index].area_m2);
  return packet;
}

}  // namespace

std::vector<ViewShare> ColumnSums::shares_and_clear() {
  std::ranges::sort(touched_);
  double all = 0.0;
  for (const std::uint32_t column : touched_) all += sums_[column];
  std::vector<ViewShare> shares;
  shares.reserve(touched_.size());
  for (const std::uint32_t column : touched_) {
    shares.push_back({column, static_cast<float>(sums_[column] / all)});
    sums_[column] = 0.0;
  }
  touched_.clear();
  return shares;
}

std::vector<ViewShare> views_of(std::span<const ReceiverInScene> receivers, const SceneOfColumns& scene,
                                const SkyDirections& directions, ColumnSums& sums, const std::stop_token& stop) {
  const std::vector<Receiver> ordered = in_order_on_surface(receivers, stop);
  for_each_normal(ordered, [&](std::span<const Receiver> group) {
    const Point3f& n = group.front().normal;
    const std::vector<Point3d> around = directions.around(normalized(Point3d{n.x, n.y, n.z}));
    for (std::size_t first = 0; first < group.size(); first += RayOrigins::lanes) {
      const std::size_t count = std::min(RayOrigins::lanes, group.size() - first);
      const PacketOfSurface packet = packet_of(group.subspan(first, count), receivers);
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (k % directions_between_looks == 0) throw_if_cancelled(stop);
        look_for_columns(scene, packet, around[k], sums);
      }
    }
  });
  return sums.shares_and_clear();
}

}  // namespace farlod
