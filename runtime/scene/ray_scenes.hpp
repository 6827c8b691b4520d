// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "base/grid.hpp"
#include "farlod/canopy.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "package/package_reader.hpp"
#include "scene/seen_building.hpp"
#include "scene/seen_surfaces.hpp"
#include "scene/triangle_index.hpp"

namespace farlod {

/// The tiles of the neighborhood of `cell`, in the frame of `cell`. Neighbors that do not exist are empty.
[[nodiscard]] Occluder near_scene(const PackageReader& package, Cell cell);

/// All tiles of a package and its far terrain as one scene: the reference that needs no far map. Its frame is the grid frame
/// moved to the corner of the middle cell, with heights as on disk. Costs memory in proportion to the city.
class WholeCity {
 public:
  /// Throws Cancelled when `stop` is asked for meanwhile.
  explicit WholeCity(const PackageReader& package, const std::stop_token& stop = {});

  [[nodiscard]] const Occluder& occluder() const { return occluder_; }
  /// Added to a place of the frame of `cell`, gives one of this scene.
  [[nodiscard]] Point2d scene_from_cell_m(Cell cell) const { return grid_.corner_of(cell) - origin_grid_; }
  /// A point of the frame of `cell` in the frame of this scene.
  [[nodiscard]] Point3f scene_from_cell(const Point3f& p_cell, Cell cell) const;

 private:
  const Grid& grid_;
  Point2d origin_grid_;
  Occluder occluder_;
};

/// The scene of the whole city, its triangles and its crowns in the frame of that scene: each is made when it is first asked for.
/// Threads may share it.
class WholeCityOnDemand {
 public:
  /// The package must outlive it. What is asked for ends with Cancelled when `stop` is asked for.
  WholeCityOnDemand(const PackageReader& package, std::stop_token stop);

  [[nodiscard]] const WholeCity& city() const;
  /// The scene for receivers of a cell.
  [[nodiscard]] PlacedScene seen_from(Cell cell) const { return {city().occluder(), city().scene_from_cell_m(cell)}; }
  /// What its triangles are.
  [[nodiscard]] const SeenSurfaces& surfaces() const;
  /// The triangles of the same scene in the same frame, to the last bit of the package.
  [[nodiscard]] const TriangleIndex& triangles() const;
  /// A place of the frame of `cell` in their frame.
  [[nodiscard]] Point3d scene_from_cell(const Point3f& p_cell, Cell cell) const;
  /// What is seen of a building; `id` is the same at each call.
  [[nodiscard]] const SeenBuilding& building(const std::string& id) const;
  /// `settings` are the same at each call.
  [[nodiscard]] const CrownOccluder& crowns(const CanopySettings& settings) const;

 private:
  const PackageReader& package_;
  std::stop_token stop_;
  mutable std::once_flag has_city_, has_surfaces_, has_building_, has_triangles_, has_crowns_;
  mutable std::optional<WholeCity> city_;
  mutable std::optional<SeenSurfaces> surfaces_;
  mutable std::optional<SeenBuilding> building_;
  mutable std::optional<TriangleIndex> triangles_;
  mutable std::optional<CrownOccluder> crowns_;
};

}  // namespace farlod
