// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "city/source.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "ingest/cityjson/cityjson_places.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

struct CityJsonPolygon {
  std::vector<std::vector<std::int64_t>> rings;  ///< rows of the vertex list, not checked yet
  SurfaceKind kind = SurfaceKind::unknown;
  std::optional<std::uint32_t> semantics = {};  ///< row of `semantics.surfaces`
};

/// The number of nested lists around the surfaces of a geometry; empty for types without surfaces.
[[nodiscard]] inline std::optional<int> nesting_of(std::string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return std::nullopt;
}

/// An instance of a template: transformed by a 4 × 4 matrix (row by row), then moved to a vertex.
struct CityJsonInstance {
  std::size_t template_row = 0;
  std::array<double, 16> matrix{};
  std::int64_t anchor = 0;
};

struct CityJsonGeometry {
  std::string type;
  double lod = 0.0;
  std::vector<CityJsonPolygon> polygons;
  std::optional<CityJsonInstance> instance;  ///< if set, the polygons are those of its template
};

struct CityJsonObject {
  std::string id, type;
  std::vector<std::string> parents, children;
  std::vector<CityJsonGeometry> geometries;
  std::optional<double> measured_height_m;
  std::string malformed;                      ///< how it breaks the format; it has no geometries then
  std::optional<CityJsonPlaces> places = {};  ///< in a file into which attributes can be inserted
};

/// The templates of a file, which all its objects may use.
struct CityJsonTemplates {
  std::vector<CityJsonGeometry> geometries;
  std::vector<Point3d> vertices;
};

/// What was read or skipped besides buildings.
struct ObjectAccount {
  std::vector<Point3d> relief_points;  ///< corners of the triangles of terrain, in its best level of detail
  SkippedFeatures skipped;             ///< types of the objects that are not used
  std::uint64_t template_corners = 0;  ///< corners that instances of templates added
  /// Polygons, rings and corners of the templates of all instances, whether or not they come to count.
  std::uint64_t template_pieces = 0;
};

/// Adds the buildings among the objects that share a vertex list: those of a CityJSON file, or of a line of a CityJSONSeq.
/// Buildings, bridges, tunnels and other constructions are read with their parts and outer installations. Terrain becomes relief
/// points. Plants, rooms, types of extensions and all others are counted as skipped. An object belongs to at most one building.
void add_objects(const std::vector<CityJsonObject>& objects, const std::vector<Point3d>& vertices,
                 const CityJsonTemplates& templates, LodChoice lod, CityModelBuilder& builder, ObjectAccount& account);

}  // namespace farlod::ingest
