// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "farlod/grid.hpp"
#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/occluder.hpp"
#include "package/package.hpp"

namespace farlod {

/// A scene, and where its frame lies: added to a place of the cell frame, gives one of the scene.
struct PlacedScene {
  const Occluder& occluder;
  Point2d scene_from_cell_m;

  [[nodiscard]] RayOrigins origins_of(const ReceiverPacket& receivers) const {
    RayOrigins origins{receivers.x, receivers.y, receivers.z};
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
      origins.x[l] = static_cast<float>(origins.x[l] + scene_from_cell_m.x);
      origins.y[l] = static_cast<float>(origins.y[l] + scene_from_cell_m.y);
    }
    return origins;
  }
};

/// The buildings around a cell that can be seen under somewhere (not SurfaceRecord::is_grounded), triangle by triangle. Cell frame.
/// Of one thread.
class OverhangGeometry {
 public:
  using TriangleCorners = std::array<Point3f, 3>;

  /// Answers with a scene of the whole city.
  using WholeScene = std::function<PlacedScene(Cell)>;

  /// The package must outlive it. With `whole_scene`, rays are traced against that instead of a scene of the cell's own.
  OverhangGeometry(const Package& package, Cell cell, WholeScene whole_scene = {});

  /// A bit for each receiver that has something overhead.
  [[nodiscard]] std::uint32_t covered(const ReceiverPacket& receivers) const;
  /// All of it in the neighborhood, for rays, or the whole city. Made when it is first asked for.
  [[nodiscard]] PlacedScene scene();

 private:
  [[nodiscard]] std::vector<TriangleCorners> triangles_in(const CellRange& cells) const;

  const Package& package_;
  Cell cell_;
  WholeScene whole_scene_;
  std::vector<TriangleCorners> overhead_;  ///< what may lie above receivers of the cell
  std::optional<Occluder> scene_;
};

}  // namespace farlod
