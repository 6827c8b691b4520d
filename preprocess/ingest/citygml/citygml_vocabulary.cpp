// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_vocabulary.hpp"

#include <algorithm>
#include <array>

#include "ingest/model_builder/surface_names.hpp"

namespace farlod::ingest {
namespace {

constexpr std::string_view gml = "http://www.opengis.net/gml";
constexpr std::string_view citygml = "http://www.opengis.net/citygml/";

template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 3> part_names{"BuildingPart", "BridgePart", "TunnelPart"};
constexpr std::array<std::string_view, 4> construction_names{"Building", "Bridge", "Tunnel", "OtherConstruction"};
constexpr std::array<std::string_view, 3> installation_names{"BuildingInstallation", "BridgeInstallation", "TunnelInstallation"};
constexpr std::array<std::string_view, 4> element_names{"BridgeConstructionElement", "BuildingConstructiveElement",
                                                        "BridgeConstructiveElement", "TunnelConstructiveElement"};
constexpr std::array<std::string_view, 30> inner_names{
    "address", "appearance", "generalizesTo", "relatedTo",
    // CityGML 1.0 and 2.0
    "interiorRoom", "interiorBuildingInstallation", "interiorBridgeRoom", "interiorBridgeInstallation", "interiorHollowSpace",
    "interiorTunnelInstallation", "IntBuildingInstallation", "IntBridgeInstallation", "IntTunnelInstallation", "Room",
    // CityGML 3.0
    "buildingRoom", "buildingSubdivision", "buildingUnit", "buildingFurniture", "bridgeRoom", "bridgeFurniture", "hollowSpace",
    "tunnelFurniture", "roomInstallation", "BuildingRoom", "BuildingFurniture", "BridgeRoom", "BridgeFurniture", "HollowSpace",
    "TunnelFurniture", "Storey"};
constexpr std::array<std::string_view, 4> member_names{"cityObjectMember", "featureMember", "featureMembers", "groupMember"};

}  // namespace

Vocabulary vocabulary_of(std::string_view space) {
  if (space.starts_with(gml)) return Vocabulary::gml;
  if (!space.starts_with(citygml)) return Vocabulary::foreign;
  const std::string_view module = space.substr(citygml.size());
  // In the namespace of the core, the version follows at once; in those of modules, the name of the module
  if (!module.empty() && module.front() >= '0' && module.front() <= '9') return Vocabulary::core;
  for (const std::string_view name : {"building/", "construction/", "bridge/", "tunnel/"})
    if (module.starts_with(name)) return Vocabulary::constructions;
  if (module.starts_with("texturedsurface/")) return Vocabulary::core;
  return module.starts_with("relief/") ? Vocabulary::relief : Vocabulary::other_citygml;
}

bool is_construction_name(std::string_view name) { return is_one_of(name, construction_names) || is_part_name(name); }

bool is_part_name(std::string_view name) { return is_one_of(name, part_names); }

bool is_installation_name(std::string_view name) { return is_one_of(name, installation_names); }

bool is_element_name(std::string_view name) { return is_one_of(name, element_names); }

bool is_inner_name(std::string_view name) { return is_one_of(name, inner_names) || is_interior_surface_name(name); }

bool is_boundary_name(std::string_view name) { return name.ends_with("Surface") && name.front() >= 'A' && name.front() <= 'Z'; }

bool is_lod_property(std::string_view name) {
  return name.size() > 4 && name.starts_with("lod") && name[3] >= '0' && name[3] <= '9';
}

bool is_member_name(std::string_view name) { return is_one_of(name, member_names); }

}  // namespace farlod::ingest
