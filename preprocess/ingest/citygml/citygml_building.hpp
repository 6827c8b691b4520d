// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "farlod/surface_kind.hpp"
#include "ingest/citygml/citygml_placement.hpp"
#include "ingest/citygml/gml_references.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

/// What a surface of a CityGML building is part of.
enum class SurfaceRole {
  boundary,      ///< a semantic surface: RoofSurface, WallSurface ...
  shell,         ///< a solid or surface of the building itself, often a copy of the semantic ones
  installation,  ///< a chimney, a dormer, a balcony
  element,       ///< a pylon or a deck: a bridge or tunnel may consist of such elements alone
  footprint,     ///< LoD 0, at the bottom
  roof_edge,     ///< LoD 0, at the top
  inside,        ///< an installation inside the building, which the file says after its geometry; not used
};

struct SurfaceUse {
  int lod = 0;
  std::uint16_t part = 0;  ///< 0: the building itself
  SurfaceRole role = SurfaceRole::shell;
  SurfaceKind kind = SurfaceKind::unknown;
  std::optional<std::size_t> placement = {};  ///< row in CityGmlBuilding::placements, where the surfaces are a prototype's
  PolygonOrigin origin = {};
};

/// One building of a CityGML file with all its parts and all its levels of detail, as read.
struct CityGmlBuilding {
  std::string id;
  std::vector<SurfaceUse> uses;
  GmlSurfaces surfaces;
  std::vector<std::optional<Placement>> placements;                    ///< empty: cannot be placed; `unread` has the reason
  std::vector<std::optional<double>> measured_height_m{std::nullopt};  ///< of the building and of each part
  std::map<std::string, std::size_t> unread;                           ///< what is not read, with its number
  PlacesOfBuilding places;

  /// Counts something that is not read. After a few kinds, all others are counted as one.
  void add_unread(std::string what);
};

/// The references of a building to ids that it does not contain.
[[nodiscard]] std::vector<std::string> foreign_references(const CityGmlBuilding& building);

/// Chooses the level of detail, and adds the building's polygons to the model: each once, semantic surfaces first. `places`: as
/// CityModelBuilder::end_building has it.
void add_building(const CityGmlBuilding& building, const GmlSurfaces& foreign, LodChoice lod, ReferenceBudget& budget,
                  CityModelBuilder& builder, const PlacesOfBuilding* places = nullptr);

}  // namespace farlod::ingest
