// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "results/city/xml_text.hpp"

namespace farlod {

/// What an element within a building is, by its name and namespace. The lists are those by which farlod-pack reads CityGML: what
/// it skips has no surfaces in the package.
enum class CityGmlThing {
  skipped,  ///< with everything inside it: rooms, addresses, elements of extensions and of other modules
  part,
  installation,
  element,   ///< a constructive element: a bridge may consist of them
  boundary,  ///< a semantic surface
  opening,   ///< a window or door of CityGML 1.0 and 2.0, whose kind is that of the surface around it
  geometry,  ///< a property lod0... to lod9...
  relation,  ///< whether an installation is inside
  other,
};

[[nodiscard]] CityGmlThing thing_of(const XmlTag& tag);
/// Whether an element outside of all buildings is a building: also a bridge, a tunnel, another construction, or a part alone.
[[nodiscard]] bool is_building(const XmlTag& tag);
/// Whether an element within geometry may hold surfaces.
[[nodiscard]] bool may_hold_surfaces(const XmlTag& tag);

/// Whether the property of an object comes before its generic attributes, or is one of them, by the sequences of the schemas.
[[nodiscard]] bool precedes_generic_attributes(const XmlTag& property);
/// The version of CityGML in a namespace of it, such as "2.0"; empty for other namespaces.
[[nodiscard]] std::string_view version_of(std::string_view space);
/// Whether a namespace is that of generic attributes, in any version.
[[nodiscard]] bool is_generics(std::string_view space);

}  // namespace farlod
