// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <vector>

#include "evaluate/traced_canopy.hpp"
#include "evaluate/visibility.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/point.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhangs.hpp"
#include "occlusion/occluder.hpp"
#include "package/far_map.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The directions that a hemisphere is divided into: the middles of equal parts.
struct HemisphereDirections {
  std::vector<Point3d> azimuths;  ///< level, of length 1, grid frame
  std::vector<float> slopes;      ///< tangents of the elevations, from the horizontal upwards

  [[nodiscard]] Point3f direction(std::size_t azimuth, std::size_t elevation) const {
    const Point3d& a = azimuths[azimuth];
    return {static_cast<float>(a.x), static_cast<float>(a.y), slopes[elevation]};
  }
};

/// What they meet, and for each azimuth the slope above which all is sky.
struct SkyParts {
  std::vector<SkyPart> parts;
  std::vector<float> horizon;
};

/// What a receiver sees that is answered by horizons, and rays in the gaps below overhangs: the horizons that HorizonEngine
/// draws without bounds. What is hidden is near where a ray meets the near scene.
[[nodiscard]] SkyParts parts_by_horizons(const HemisphereDirections& directions, const Receiver& receiver, const FarHorizon& far,
                                         const CellSilhouettes& silhouettes, OverhangGeometry& overhangs, const Occluder& near,
                                         const std::stop_token& stop);

/// What a receiver sees that is answered by rays against a scene.
[[nodiscard]] SkyParts parts_by_rays(const HemisphereDirections& directions, const Receiver& receiver, const Occluder& near,
                                     const RayScene& scene, const std::stop_token& stop);

/// Makes the parts crowns that meet one before anything solid. The scene has the frame of the receiver.
void mark_crowns(const HemisphereDirections& directions, const Receiver& receiver, const CanopyScene& scene,
                 const std::stop_token& stop, SkyParts& seen);

}  // namespace farlod
