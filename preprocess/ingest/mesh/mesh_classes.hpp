// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/mesh/mesh.hpp"

namespace farlod::ingest {

/// What the faces of a name are.
enum class MeshClass {
  building,  ///< all that is not known to be another thing
  ground,
  other  ///< trees, furniture
};

/// By the name of a group, an object or a material: "Terrain", "water_1", "Road.002", as 3dfier, City4CFD and exporters of
/// CityGML write them. A name that has further words is a building's: "Water Street 5". `ground_names`: further names of ground,
/// which the user gives.
[[nodiscard]] MeshClass class_of_name(std::string_view name, std::span<const std::string> ground_names = {});

/// Those of the names that an object, a group or a material of the mesh has.
[[nodiscard]] std::vector<std::string> met_names(const Mesh& mesh, std::span<const std::string> ground_names);

/// The class of a face: the first of its object, group and material that is no building decides.
class MeshClasses {
 public:
  MeshClasses(const Mesh& mesh, std::span<const std::string> ground_names);
  [[nodiscard]] MeshClass of(const MeshFace& face) const;
  /// The name that decides, for the user. The face is no building.
  [[nodiscard]] std::string name_of(const MeshFace& face) const;

 private:
  const Mesh& mesh_;
  std::vector<MeshClass> objects_, groups_, materials_;
};

}  // namespace farlod::ingest
