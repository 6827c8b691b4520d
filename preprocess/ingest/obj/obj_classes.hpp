// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "ingest/obj/obj_mesh.hpp"

namespace farlod::ingest {

/// What the faces of a name are.
enum class ObjClass {
  building,  ///< all that is not known to be another thing
  ground,
  other  ///< trees, furniture
};

/// By the name of a group, an object or a material: "Terrain", "water_1", "Road.002", as 3dfier, City4CFD and exporters of
/// CityGML write them. A name that has further words is a building's: "Water Street 5".
[[nodiscard]] ObjClass class_of_name(std::string_view name);

/// The class of a face: the first of its object, group and material that is no building decides.
class ObjClasses {
 public:
  explicit ObjClasses(const ObjMesh& mesh);
  [[nodiscard]] ObjClass of(const ObjFace& face) const;
  /// The name that decides, for the user. The face is no building.
  [[nodiscard]] std::string name_of(const ObjFace& face) const;

 private:
  const ObjMesh& mesh_;
  std::vector<ObjClass> objects_, groups_, materials_;
};

}  // namespace farlod::ingest
