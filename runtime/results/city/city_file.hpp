// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "farlod/surface_kind.hpp"
#include "results/city/surface_attributes.hpp"

namespace farlod {

/// The level of detail that a package was made of (`farlod-pack --lod`): 1 to 3; empty: the best of them.
using PackedLod = std::optional<int>;

/// Where attributes are inserted into the text of a city file.
struct AttributePlace {
  std::size_t at = 0;    ///< the byte before which they come
  std::size_t form = 0;  ///< what has to be written around them there; each format has its own forms
};

/// A semantic surface: an object of `semantics.surfaces` of CityJSON, a RoofSurface or the like of CityGML.
struct FileSemantics {
  SurfaceKind kind = SurfaceKind::unknown;
  std::optional<AttributePlace> place;  ///< empty: attributes have no place
};

/// A surface of a package, found again in its file.
struct NumberedPolygon {
  std::uint32_t number = 0;              ///< SurfacePoint::surface
  std::size_t object = 0;                ///< in FileBuilding::objects
  std::optional<std::size_t> semantics;  ///< in FileBuilding::semantics
  double area = 0.0;                     ///< in the units of the file
  double steepness = 0.0;                ///< |cos| of the tilt of its normal; meaningless where coordinates are degrees
};

/// A building of the package.
struct FileBuilding {
  std::string id;
  /// The objects that it was made of: the building itself first, then parts and installations. Empty: attributes have no place.
  std::vector<std::optional<AttributePlace>> objects;
  std::vector<FileSemantics> semantics;  ///< of the polygons; those of templates, which many objects share, are not here
  /// In the order of their numbers. A polygon that is there twice has the number of the first one twice.
  std::vector<NumberedPolygon> polygons;
  /// The attributes that the objects and the semantic surfaces, also those of other levels of detail, have in the file.
  std::vector<std::string> names_of_objects, names_of_surfaces;
};

/// A city file in memory whose surfaces can be found by the numbers that farlod-pack gives them.
class CityFile {
 public:
  CityFile() = default;
  CityFile(const CityFile&) = delete;
  CityFile& operator=(const CityFile&) = delete;
  CityFile(CityFile&&) = delete;
  CityFile& operator=(CityFile&&) = delete;
  virtual ~CityFile() = default;

  [[nodiscard]] virtual const std::string& text() const = 0;
  /// What it holds.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Whether its coordinates are longitudes and latitudes, so that areas and tilts of its surfaces mean nothing.
  [[nodiscard]] virtual bool has_degrees() const = 0;
  /// The ids that several objects of the file have.
  [[nodiscard]] virtual const std::unordered_set<std::string>& repeated_ids() const = 0;
  /// Calls `on` for each building, with its polygons numbered as farlod-pack numbers them (docs/stages/ingest.md): one after the
  /// other in the level of detail that was packed, also those that are unusable. One building is in memory at a time. Geometry is
  /// read now: throws JsonCursorError or XmlTextError where it is malformed (telling_file).
  virtual void for_each_building(PackedLod lod, const std::function<void(const FileBuilding&)>& on) const = 0;
  /// What is inserted at a place of this form. There is at least one attribute.
  [[nodiscard]] virtual std::string text_of(const CityAttributes& attributes, std::size_t form) const = 0;
};

}  // namespace farlod
