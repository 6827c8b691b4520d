// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "city/source.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

struct CityJsonPolygon {
  std::vector<std::vector<std::int64_t>> rings;  ///< rows of the vertex list; the file may be wrong about them
  SurfaceKind kind = SurfaceKind::unknown;
};

/// A use of a template: turned and scaled by a matrix (row by row, 4 × 4), then moved to a vertex.
struct CityJsonInstance {
  std::size_t template_row = 0;
  std::array<double, 16> matrix{};
  std::int64_t anchor = 0;
};

struct CityJsonGeometry {
  std::string type;
  double lod = 0.0;
  std::vector<CityJsonPolygon> polygons;
  std::optional<CityJsonInstance> instance;  ///< then the polygons are those of the template
};

struct CityJsonObject {
  std::string id, type;
  std::vector<std::string> parents, children;
  std::vector<CityJsonGeometry> geometries;
  std::optional<double> measured_height_m;
  std::string malformed;  ///< what does not follow the format; then there are no geometries
};

/// Templates, common to all objects of a file.
struct CityJsonTemplates {
  std::vector<CityJsonGeometry> geometries;
  std::vector<Point3d> vertices;
};

/// What the objects hold besides buildings.
struct ObjectAccount {
  std::vector<Point3d> relief_points;  ///< corners of the triangles of terrain, in its best level of detail
  SkippedFeatures skipped;             ///< types of the objects that are not used
  std::uint64_t template_corners = 0;  ///< written by using templates
};

/// Writes the buildings among the objects of one vertex list: of a CityJSON file, or of one line of a CityJSONSeq.
/// Buildings, bridges, tunnels and other constructions hide the sky, with their parts and outer installations. Terrain is ground;
/// plants, rooms, types of extensions and all else are counted. An object belongs to one building at the most.
void add_objects(const std::vector<CityJsonObject>& objects, const std::vector<Point3d>& vertices,
                 const CityJsonTemplates& templates, LodChoice lod, CityModelBuilder& builder, ObjectAccount& account);

}  // namespace farlod::ingest
