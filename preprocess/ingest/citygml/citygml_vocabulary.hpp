// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace farlod::ingest {

/// What the namespace of an element tells, whatever the version of CityGML and of GML.
enum class Vocabulary {
  gml,
  core,           ///< CityGML's core, and textured surfaces
  constructions,  ///< buildings, bridges, tunnels and other constructions
  relief,
  other_citygml,  ///< a module that holds nothing of a construction: generics, appearance, vegetation ...
  foreign,        ///< an application domain extension (ADE)
};

[[nodiscard]] Vocabulary vocabulary_of(std::string_view space);

/// Whether elements can lead to the surfaces of a construction.
[[nodiscard]] inline bool may_hold_surfaces(Vocabulary vocabulary) {
  return vocabulary == Vocabulary::gml || vocabulary == Vocabulary::core || vocabulary == Vocabulary::constructions;
}

/// Building, Bridge, Tunnel, OtherConstruction: what is a building to us. Parts as well, since one that stands alone is as
/// good as a building.
[[nodiscard]] bool is_construction_name(std::string_view name);
[[nodiscard]] bool is_part_name(std::string_view name);
/// Balconies, chimneys, portals: what stands at the outside.
[[nodiscard]] bool is_installation_name(std::string_view name);
/// Pylons, decks, walls, slabs: what a construction may wholly consist of.
[[nodiscard]] bool is_element_name(std::string_view name);
/// Rooms, hollow spaces, furniture, addresses, and the properties that hold them or that lead to other buildings.
[[nodiscard]] bool is_inner_name(std::string_view name);
/// RoofSurface, WallSurface, and all others of their kind.
[[nodiscard]] bool is_boundary_name(std::string_view name);
/// lod0 to lod9 and something: a property with geometry.
[[nodiscard]] bool is_lod_property(std::string_view name);
/// Properties that hold objects of a city, each of which is one.
[[nodiscard]] bool is_member_name(std::string_view name);

}  // namespace farlod::ingest
