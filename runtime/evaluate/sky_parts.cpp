// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_parts.hpp"

#include <limits>

#include "base/cancellation.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/recesses.hpp"
#include "horizon/residual_horizon.hpp"

namespace farlod {
namespace {

constexpr std::uint32_t only_receiver = 1;

SkyPart part_of_hidden(const Occluder& near, const Receiver& receiver, const Point3f& direction) {
  return near.blocks({receiver.p_cell, direction, least_distance_m}) ? SkyPart::near : SkyPart::far;
}

bool is_in_gap(const OverhangHorizons& h, std::size_t azimuth, float slope) {
  const auto below = [&](const PacketHorizon& horizon) { return (horizon.below(azimuth, slope) & only_receiver) != 0; };
  const bool in_far_city = below(h.far_lower_borders) && !below(h.far_upper_borders);
  return below(h.grounded) && !below(h.lower_borders) && !in_far_city;
}

/// The horizons of one receiver, as the engine `auto` draws them.
OverhangHorizons drawn_horizons(const AzimuthSampling& azimuths, const ReceiverPacket& packet, const FarHorizon& far,
                                const CellSilhouettes& silhouettes, OverhangGeometry& overhangs) {
  OverhangHorizons horizons(azimuths);
  ResidualHorizon residual(far, azimuths);
  const auto begin = [&residual](const ReceiverPacket& receivers, PacketHorizon& horizon) {
    residual.raise_to_estimate(receivers, horizon);
  };
  begin(packet, horizons.grounded);
  horizons.grounded.raise(silhouettes.grounded, packet);
  Recesses recesses(azimuths, silhouettes);
  const Overhead overhead = recesses.overhead_of(packet, overhangs.receivers_below(packet));
  recesses.draw_again(packet, overhead, begin, horizons.grounded);
  horizons.upper_borders = horizons.lower_borders = horizons.grounded;
  horizons.draw_overhangs(silhouettes, packet, overhead, FarGapEnd::lowest);
  horizons.lower_borders.lower_to(horizons.upper_borders);
  return horizons;
}

}  // namespace

SkyParts parts_by_horizons(const HemisphereDirections& directions, const Receiver& receiver, const FarHorizon& far,
                           const CellSilhouettes& silhouettes, OverhangGeometry& overhangs, const Occluder& near,
                           const std::stop_token& stop) {
  const AzimuthSampling azimuths(directions.azimuths);
  ReceiverPacket packet;
  packet.add(receiver);
  const OverhangHorizons horizons = drawn_horizons(azimuths, packet, far, silhouettes, overhangs);
  const bool has_gaps = horizons.lower_borders.exceeds(horizons.grounded) != 0;
  // Compare the directions with them; those in gaps are traced
  const std::size_t elevations = directions.slopes.size();
  SkyParts result{std::vector(azimuths.size() * elevations, SkyPart::sky), std::vector<float>(azimuths.size())};
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    throw_if_cancelled(stop);
    const std::size_t n = azimuths.order()[k];
    result.horizon[n] = horizons.upper_borders.row(k)[0];
    for (std::size_t e = 0; e < elevations && directions.slopes[e] <= result.horizon[n]; ++e) {
      const Point3f direction = directions.direction(n, e);
      if (has_gaps && is_in_gap(horizons, k, directions.slopes[e])) {
        const PlacedScene scene = overhangs.scene();
        if ((scene.occluder.blocked(origins_of(packet, scene.scene_from_cell_m), direction, least_distance_m, only_receiver) &
             only_receiver) == 0)
          continue;
      }
      result.parts[n * elevations + e] = part_of_hidden(near, receiver, direction);
    }
  }
  return result;
}

SkyParts parts_by_rays(const HemisphereDirections& directions, const Receiver& receiver, const Occluder& near,
                       const RayScene& scene, const std::stop_token& stop) {
  const std::size_t elevations = directions.slopes.size();
  SkyParts result{std::vector(directions.azimuths.size() * elevations, SkyPart::sky),
                  std::vector<float>(directions.azimuths.size(), 0.0F)};
  for (std::size_t n = 0; n < directions.azimuths.size(); ++n) {
    throw_if_cancelled(stop);
    for (std::size_t e = 0; e < elevations; ++e) {
      const Point3f direction = directions.direction(n, e);
      if (!scene.blocks(receiver.p_cell, direction)) continue;
      result.parts[n * elevations + e] = part_of_hidden(near, receiver, direction);
      // The sky begins in the middle between two directions
      result.horizon[n] =
          e + 1 < elevations ? 0.5F * (directions.slopes[e] + directions.slopes[e + 1]) : std::numeric_limits<float>::infinity();
    }
  }
  return result;
}

void mark_crowns(const HemisphereDirections& directions, const Receiver& receiver, const CanopyScene& scene,
                 const std::stop_token& stop, SkyParts& seen) {
  const RayOrigins origins = gathered({&receiver.p_cell, 1});
  const std::size_t elevations = directions.slopes.size();
  for (std::size_t n = 0; n < directions.azimuths.size(); ++n) {
    throw_if_cancelled(stop);
    for (std::size_t e = 0; e < elevations; ++e) {
      const Point3f direction = directions.direction(n, e);
      const CrownLights light = scene.crowns.light(origins, direction, least_distance_m, only_receiver);
      SkyPart& part = seen.parts[n * elevations + e];
      if ((light.met & only_receiver) != 0 &&
          (part == SkyPart::sky || is_crown_first(scene.solid, origins, 0, direction, light.nearest[0])))
        part = SkyPart::crown;
    }
  }
}

}  // namespace farlod
