// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "farlod/surface_kind.hpp"
#include "ingest/city_writer.hpp"
#include "ingest/gml_surfaces.hpp"
#include "ingest/lod_choice.hpp"

namespace farlod {

/// What a surface of a CityGML building is part of.
enum class SurfaceRole {
  boundary,      ///< a semantic surface: RoofSurface, WallSurface ...
  shell,         ///< a solid or surface of the building itself, often a copy of the semantic ones
  installation,  ///< a chimney, a dormer, a balcony
  footprint,     ///< LoD 0, at the bottom
  roof_edge,     ///< LoD 0, at the top
};

struct SurfaceUse {
  int lod = 0;
  std::uint16_t part = 0;  ///< 0: the building itself
  SurfaceRole role = SurfaceRole::shell;
  SurfaceKind kind = SurfaceKind::unknown;
};

/// One building of a CityGML file with all its parts and all its levels of detail, as read.
struct CityGmlBuilding {
  std::string id;
  std::vector<SurfaceUse> uses;
  GmlSurfaces surfaces;
  std::vector<std::optional<double>> measured_height_m{std::nullopt};  ///< of the building and of each part
  std::vector<std::string> unread;                                     ///< geometries of kinds that are not read
};

/// The references of a building that nothing within it answers.
[[nodiscard]] std::vector<std::string> foreign_references(const CityGmlBuilding& building);

/// Chooses the level of detail and writes the building's polygons, each once, semantic surfaces first.
void write_building(const CityGmlBuilding& building, const GmlSurfaces& foreign, LodChoice lod, CityWriter& writer);

}  // namespace farlod
