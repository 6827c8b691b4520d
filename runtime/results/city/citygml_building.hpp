// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "results/city/city_file.hpp"
#include "results/city/citygml_surfaces.hpp"

namespace farlod {

/// What a surface of a building is part of.
enum class CityGmlRole {
  boundary,      ///< a semantic surface
  shell,         ///< a solid or surface of the building itself, often a copy of the semantic ones
  installation,  ///< follows the level of detail of its building, and never decides it
  element,       ///< decides it only where there is nothing else
  outline,       ///< a footprint or roof edge
  inside,        ///< an installation inside the building, which is not packed
};

struct CityGmlUse {
  int lod = 0;
  std::size_t part = 0;  ///< 0: the building itself
  CityGmlRole role = CityGmlRole::shell;
  std::size_t object = 0;                ///< in FileBuilding::objects
  std::optional<std::size_t> semantics;  ///< in FileBuilding::semantics
  std::optional<std::size_t> placement;  ///< in CityGmlBuildingText::placements, where the surfaces are a prototype's
};

/// Where a prototype (ImplicitGeometry) comes to lie.
class PrototypePlacement {
 public:
  /// From the 16 numbers of a matrix, row by row; without numbers, the matrix is the identity. Empty where they are not 16 finite
  /// numbers.
  [[nodiscard]] static std::optional<PrototypePlacement> from(std::span<const double> matrix, const Point3d& reference_point);
  [[nodiscard]] FileRings place(const FileRings& rings) const;

 private:
  Point3d x_axis_{1, 0, 0}, y_axis_{0, 1, 0}, z_axis_{0, 0, 1}, origin_;
};

/// A building of a CityGML file with all its levels of detail, as read.
struct CityGmlBuildingText {
  FileBuilding building;  ///< without polygons
  std::size_t parts = 0;
  std::vector<CityGmlUse> uses;
  CityGmlSurfaces surfaces;
  std::vector<std::optional<PrototypePlacement>> placements;  ///< empty: farlod-pack cannot place it
};

/// The building with its polygons numbered. `foreign`: what buildings refer to outside of themselves; `foreign_left`: as
/// CityGmlWalk has it. Surfaces that are a prototype's, or stand outside of the building, have no semantics.
[[nodiscard]] FileBuilding numbered(CityGmlBuildingText text, const CityGmlSurfaces& foreign, PackedLod lod,
                                    std::size_t& foreign_left);

}  // namespace farlod
