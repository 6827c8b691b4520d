// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace farlod {

enum class CityFileFormat : std::uint8_t { citygml = 1, cityjson = 2, cityjsonseq = 3 };

/// What is written around attributes at a place of a file: `before_all`, then for each attribute `before_name`, its name,
/// `before_value`, its value and `behind_value`, with `between` from one to the next, then `behind_all`.
struct AttributeForm {
  std::string before_all, before_name, before_value, behind_value, between, behind_all;
  bool operator==(const AttributeForm&) const = default;
};

/// Where attributes of an object or of a semantic surface are inserted into a file.
struct AttributePlace {
  std::uint64_t at = 0;    ///< the byte before which they come; below 2⁶⁰
  std::uint32_t form = 0;  ///< counted from 1 among the forms of the file; 0: attributes have no place
  bool operator==(const AttributePlace&) const = default;
};

struct SurfaceOrigin {
  std::uint32_t surface = 0;                    ///< its number within the building, as SurfaceMean has it
  std::uint32_t object = 0;                     ///< in BuildingOrigin::objects
  std::optional<std::uint32_t> semantics = {};  ///< in BuildingOrigin::semantics
  bool operator==(const SurfaceOrigin&) const = default;
};

/// What the file calls consecutive surfaces of a building.
struct SurfaceIds {
  std::uint32_t begin = 0, end = 0;  ///< numbers of surfaces, half open
  std::string id;                    ///< at most 256 bytes, of which the first is not 0
  bool behind_building_id = false;   ///< whether the id of the building stands before it
  bool operator==(const SurfaceIds&) const = default;
};

/// Where a building comes from.
struct BuildingOrigin {
  std::vector<AttributePlace> objects;    ///< the building itself first, then those of its parts and installations with surfaces
  std::vector<AttributePlace> semantics;  ///< of the surfaces
  /// In ascending order of their numbers. A polygon that the file has several times is there as often, with the object of the
  /// first. A surface of the building itself without semantics is not there.
  std::vector<SurfaceOrigin> surfaces;
  /// In ascending order. A surface without an id in the file is not there; older packages have none.
  std::vector<SurfaceIds> ids = {};
  bool operator==(const BuildingOrigin&) const = default;
};

}  // namespace farlod
