// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/building_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "base/cancellation.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {
namespace {

/// A place of the unit square: the k-th of a Fibonacci lattice.
Point2d lattice_point(std::size_t k, std::size_t count) {
  const double turns = static_cast<double>(k) * std::numbers::phi;
  return {turns - std::floor(turns), (static_cast<double>(k) + 0.5) / static_cast<double>(count)};
}

/// A receiver that looks for the building, and what its rays have met so far.
struct Onlooker {
  Point3d normal;
  DirectionWindow window;
  bool looks_around = false;
  double weights = 0.0;  ///< of the rays before its front that meet the building
  bool sees = false;

  /// The share of the view that a solid angle fills in a direction before the front: the whole front is 1.
  [[nodiscard]] double weight_of(const Point3d& towards, SkyWeight weight) const {
    const double cosine = dot(normal, towards);
    if (cosine <= 0.0) return 0.0;
    return weight == SkyWeight::cosine ? cosine / std::numbers::pi : 0.5 / std::numbers::pi;
  }
};

/// Receivers near each other, whose rays go to the same places of the building.
struct PacketOfOnlookers {
  RayOrigins origins;
  std::array<Onlooker, RayOrigins::lanes> lanes;
  std::size_t count = 0;
};

PacketOfOnlookers packet_of(std::span<const Receiver> receivers, const BuildingScene& scene, bool on_surfaces) {
  PacketOfOnlookers packet;
  packet.count = receivers.size();
  std::vector<Point3f> places;
  for (std::size_t l = 0; l < receivers.size(); ++l) {
    const Point3f& n = receivers[l].normal;
    places.push_back(placed(receivers[l].p_cell, scene.solid.scene_from_cell_m));
    Onlooker& onlooker = packet.lanes[l];
    onlooker.normal = normalized(Point3d{n.x, n.y, n.z});
    onlooker.window = scene.building.window_from(places.back());
    onlooker.looks_around = !on_surfaces && n == Point3f{0.0F, 0.0F, 1.0F};
  }
  packet.origins = gathered(places);
  return packet;
}

/// The rays of a packet to a place of the window.
void look_at(Point2d p_square, const BuildingScene& scene, SkyWeight weight, PacketOfOnlookers& packet) {
  Occluder::Directions directions = Occluder::Directions::all_of({0.0F, 0.0F, 1.0F});
  std::array<double, RayOrigins::lanes> weights{};
  std::uint32_t wanted = 0;
  for (std::size_t l = 0; l < packet.count; ++l) {
    const Onlooker& onlooker = packet.lanes[l];
    const Point3d towards = onlooker.window.direction(p_square);
    directions.x[l] = static_cast<float>(towards.x);
    directions.y[l] = static_cast<float>(towards.y);
    directions.z[l] = static_cast<float>(towards.z);
    weights[l] = onlooker.weight_of(towards, weight);
    if (weights[l] > 0.0 || onlooker.looks_around) wanted |= 1U << l;
  }
  const Occluder::Hits hits = scene.solid.occluder.nearest(packet.origins, directions, least_distance_m, wanted);
  const std::uint32_t crowns =
      scene.crowns == nullptr ? 0
                              : scene.crowns->met_before(hits.distances, packet.origins, directions, least_distance_m, wanted);
  for (std::size_t l = 0; l < packet.count; ++l) {
    const bool is_met = std::isfinite(hits.distances[l]) && !has_bit(crowns, l) && scene.building.has(hits.triangles[l]);
    if (!has_bit(wanted, l) || !is_met) continue;
    packet.lanes[l].weights += weights[l];
    packet.lanes[l].sees = true;
  }
}

}  // namespace

void store_building_views(const CellReceivers& cell, const BuildingScene& scene, const BuildingLook& look,
                          const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop) {
  std::vector<Receiver> ordered;
  for (const std::uint32_t n : packet_order(cell.receivers, stop).numbers) ordered.push_back(cell.receivers[n]);
  for (std::size_t first = 0; first < ordered.size(); first += RayOrigins::lanes) {
    const std::span<const Receiver> together =
        std::span(ordered).subspan(first, std::min(RayOrigins::lanes, ordered.size() - first));
    PacketOfOnlookers packet = packet_of(together, scene, look.on_surfaces);
    for (std::size_t k = 0; k < look.rays; ++k) {
      if (k % directions_between_looks == 0) throw_if_cancelled(stop);
      look_at(lattice_point(k, look.rays), scene, look.weight, packet);
    }
    for (std::size_t l = 0; l < together.size(); ++l) {
      const Onlooker& onlooker = packet.lanes[l];
      const double of_ray = onlooker.window.solid_angle() / static_cast<double>(look.rays);
      const std::size_t at = together[l].index * quantities.size() + quantities.view_columns().building.first;
      answers.further[at] = static_cast<float>(onlooker.weights * of_ray);
      answers.further[at + 1] = onlooker.sees ? 1.0F : 0.0F;
    }
  }
}

}  // namespace farlod
