// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "ingest/mesh/mesh.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// How the coordinates of a mesh are brought into its CRS.
struct MeshFrame {
  Point3d origin;  ///< added to the coordinates after their vertical axis is z
  UpAxis up = UpAxis::z;
};

/// What a mesh holds besides buildings.
struct MeshRest {
  std::vector<Point3d> relief_points;                 ///< corners of its ground
  std::map<std::string, std::uint64_t> ground_faces;  ///< their number, by the name that says what they are
  std::map<std::string, std::uint64_t> sheet_faces;   ///< of ground that is known by its form (find_ground_sheets), by its name
  SkippedFeatures skipped;
};

/// Adds the buildings of a mesh. A building is a group; an object if there is more than one; or, without either, a connected
/// component. A repeated name begins another building. Coplanar neighboring faces share a surface number. Works on all threads of
/// the task arena that it is called in. Returns what the names of groups, objects and materials, or their form, say to be no
/// building; `ground_names` are the user's. Throws Cancelled when a stop is requested.
MeshRest add_buildings(const Mesh& mesh, const MeshFrame& frame, std::span<const std::string> ground_names,
                       CityModelBuilder& builder, const std::stop_token& stop = {});

}  // namespace farlod::ingest
