// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "base/frame.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_directions.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/kernels.hpp"
#include "horizon/sky_profile.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "receivers/receiver.hpp"
#include "scene/seen_surfaces.hpp"

namespace farlod {

/// A scene of the whole city, what its triangles are, and its crowns in the same frame.
struct SeenScene {
  PlacedScene solid;
  const SeenSurfaces& surfaces;
  const CrownOccluder* crowns = nullptr;  ///< null where there are none
};

/// Stores the columns of Quantities::view_factors and ::view_factors_below of receivers whose svf is stored, by rays in their
/// directions. Rays say how the sky is divided among sky and crowns, and what hides it among classes, and the lower half
/// likewise; how large the three parts are tell svf and the receiver's normal, so that all add up to 1. A part that no ray lies
/// in is `other`, but for the sky. Of one thread.
class ViewFactors {
 public:
  /// All must outlive it. `weight` is that of svf and of the directions.
  ViewFactors(SeenScene scene, const SkyDirections& directions, SkyWeight weight, const FurtherQuantities& quantities,
              const SkyAnswers& answers, std::stop_token stop)
      : scene_(scene),
        directions_(directions),
        weight_(weight),
        quantities_(quantities),
        answers_(answers),
        stop_(std::move(stop)) {}

  /// Those of all receivers of a cell. Throws Cancelled when `stop` is asked for.
  void store(const CellReceivers& cell);
  /// Those of a packet of receivers, whose profile is known, or null: no ray is traced above its horizons.
  void store(std::span<const Receiver> packet, const SkyProfile* profile);

 private:
  void turn_to(const Point3f& normal);
  void find_known_sky(const SkyProfile* profile);
  void store_alike(std::span<const Receiver> receivers, std::size_t first_lane);

  SeenScene scene_;
  const SkyDirections& directions_;
  SkyWeight weight_;
  const FurtherQuantities& quantities_;
  const SkyAnswers& answers_;
  std::stop_token stop_;
  Point3f normal_{0.0F, 0.0F, 0.0F};  ///< of the receivers that were asked last
  std::vector<Point3d> around_;
  std::vector<RayBetweenAzimuths> rays_;  ///< these directions
  std::vector<std::uint16_t> in_sky_;     ///< for each of them, a bit for each receiver of the packet
};

/// So many directions in the grid frame, within ±`field_deg` of the horizontal and alike in solid angle.
[[nodiscard]] std::vector<Point3d> eye_directions(double field_deg, std::size_t count, const GridRotation& rotation);
/// Stores the columns of Quantities::view_eye of the receivers of a cell: shares of these directions.
void store_views_of_eye(const CellReceivers& cell, const SeenScene& scene, std::span<const Point3d> directions,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop);

}  // namespace farlod
