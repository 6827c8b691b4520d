// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace farlod::ingest {

/// The vocabulary that the namespace of an element belongs to, in any version of CityGML and GML.
enum class Vocabulary {
  gml,
  core,           ///< the core of CityGML, and textured surfaces
  constructions,  ///< buildings, bridges, tunnels and other constructions
  relief,
  other_citygml,  ///< a module without parts of constructions: generics, appearance, vegetation ...
  foreign,        ///< an application domain extension (ADE)
};

[[nodiscard]] Vocabulary vocabulary_of(std::string_view space);

/// Whether elements of a vocabulary can contain surfaces of a construction.
[[nodiscard]] inline bool may_hold_surfaces(Vocabulary vocabulary) {
  return vocabulary == Vocabulary::gml || vocabulary == Vocabulary::core || vocabulary == Vocabulary::constructions;
}

/// Building, Bridge, Tunnel, OtherConstruction, which all count as buildings, and their parts, which may occur alone.
[[nodiscard]] bool is_construction_name(std::string_view name);
[[nodiscard]] bool is_part_name(std::string_view name);
/// Installations outside of a building: balconies, chimneys, portals.
[[nodiscard]] bool is_installation_name(std::string_view name);
/// Constructive elements, of which a construction may consist entirely: pylons, decks, walls, slabs.
[[nodiscard]] bool is_element_name(std::string_view name);
/// Rooms, hollow spaces, furniture, addresses, and the properties that contain them or refer to other buildings.
[[nodiscard]] bool is_inner_name(std::string_view name);
/// Semantic surfaces: RoofSurface, WallSurface ...
[[nodiscard]] bool is_boundary_name(std::string_view name);
/// A property with geometry: lod0 to lod9, followed by the kind of geometry.
[[nodiscard]] bool is_lod_property(std::string_view name);
/// Properties that contain one object of the city each.
[[nodiscard]] bool is_member_name(std::string_view name);

}  // namespace farlod::ingest
