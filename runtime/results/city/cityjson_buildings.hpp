// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "farlod/surface_kind.hpp"
#include "results/city/cityjson_file.hpp"

namespace farlod {

/// The level of detail that a package was made of (`farlod-pack --lod`): 1 to 3; empty: the best of them.
using PackedLod = std::optional<int>;

/// A surface of a package, found again in its file.
struct NumberedPolygon {
  std::uint32_t number = 0;              ///< SurfacePoint::surface
  std::size_t object = 0;                ///< in FileBuilding::objects
  std::optional<std::size_t> semantics;  ///< in FileBuilding::semantics
  double area = 0.0;                     ///< in the units of the file
  double steepness = 0.0;                ///< |cos| of the tilt of its normal; meaningless where coordinates are degrees
};

/// A building of the package, with the objects that it was made of: the building itself first, then parts and installations.
struct FileBuilding {
  struct Object {
    const FileObject* object = nullptr;
    FileObjectContents contents;
  };
  std::string id;
  std::vector<Object> objects;
  std::vector<const SemanticSurface*> semantics;  ///< of the polygons; those of templates, which many objects share, are not here
  /// In the order of the file. A polygon that is there twice has the number of the first one twice.
  std::vector<NumberedPolygon> polygons;
};

/// Calls `on` for each building of a file, with its polygons numbered as farlod-pack numbers them (docs/stages/ingest.md): one
/// after the other in the level of detail that was packed, also those that are unusable; a polygon that an earlier geometry of
/// the building has already is none. One building is in memory at a time. Throws JsonCursorError.
void for_each_building(const CityJsonFile& file, PackedLod lod, const std::function<void(const FileBuilding&)>& on);

}  // namespace farlod
