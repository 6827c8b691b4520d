// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_names.hpp"

#include <algorithm>
#include <array>

namespace farlod {
namespace {

constexpr std::string_view gml = "http://www.opengis.net/gml", citygml = "http://www.opengis.net/citygml/";

template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::ranges::find(names, name) != names.end();
}

constexpr std::array<std::string_view, 3> parts{"BuildingPart", "BridgePart", "TunnelPart"};
constexpr std::array<std::string_view, 4> constructions{"Building", "Bridge", "Tunnel", "OtherConstruction"};
constexpr std::array<std::string_view, 4> installations{"BuildingInstallation", "BridgeInstallation", "TunnelInstallation",
                                                        "OtherConstruction"};
constexpr std::array<std::string_view, 4> elements{"BridgeConstructionElement", "BuildingConstructiveElement",
                                                   "BridgeConstructiveElement", "TunnelConstructiveElement"};
constexpr std::array<std::string_view, 33> inner{
    "address", "appearance", "generalizesTo", "relatedTo", "InteriorWallSurface", "CeilingSurface", "FloorSurface",
    // CityGML 1.0 and 2.0
    "interiorRoom", "interiorBuildingInstallation", "interiorBridgeRoom", "interiorBridgeInstallation", "interiorHollowSpace",
    "interiorTunnelInstallation", "IntBuildingInstallation", "IntBridgeInstallation", "IntTunnelInstallation", "Room",
    // CityGML 3.0
    "buildingRoom", "buildingSubdivision", "buildingUnit", "buildingFurniture", "bridgeRoom", "bridgeFurniture", "hollowSpace",
    "tunnelFurniture", "roomInstallation", "BuildingRoom", "BuildingFurniture", "BridgeRoom", "BridgeFurniture", "HollowSpace",
    "TunnelFurniture", "Storey"};
/// In CityGML 3.0, appearances come before generic attributes; in older versions either may come first.
constexpr std::array<std::string_view, 13> before_generic_attributes{"adeOfAbstractFeature",
                                                                     "creationDate",
                                                                     "terminationDate",
                                                                     "validFrom",
                                                                     "validTo",
                                                                     "adeOfAbstractFeatureWithLifespan",
                                                                     "externalReference",
                                                                     "generalizesTo",
                                                                     "relativeToTerrain",
                                                                     "relativeToWater",
                                                                     "relatedTo",
                                                                     "appearance",
                                                                     "genericAttribute"};

/// Behind the beginning that all namespaces of CityGML share: of the core, the version follows at once.
std::string_view module_of(std::string_view space) { return space.starts_with(citygml) ? space.substr(citygml.size()) : ""; }

bool is_core(std::string_view space) {
  const std::string_view module = module_of(space);
  return !module.empty() && module.front() >= '0' && module.front() <= '9';
}

bool is_of_constructions(std::string_view space) {
  const std::string_view module = module_of(space);
  return std::ranges::any_of(std::array<std::string_view, 4>{"building/", "construction/", "bridge/", "tunnel/"},
                             [&](std::string_view name) { return module.starts_with(name); });
}

bool is_lod_property(std::string_view name) {
  return name.size() > 4 && name.starts_with("lod") && name[3] >= '0' && name[3] <= '9';
}

bool is_class_of_surfaces(std::string_view name) {
  return name.ends_with("Surface") && name.front() >= 'A' && name.front() <= 'Z';
}

}  // namespace

bool may_hold_surfaces(const XmlTag& tag) {
  return tag.space.starts_with(gml) || is_core(tag.space) || is_of_constructions(tag.space) ||
         module_of(tag.space).starts_with("texturedsurface/");
}

bool is_building(const XmlTag& tag) {
  return is_of_constructions(tag.space) && (is_one_of(tag.name, constructions) || is_one_of(tag.name, parts));
}

CityGmlThing thing_of(const XmlTag& tag) {
  if (!may_hold_surfaces(tag) || is_one_of(tag.name, inner)) return CityGmlThing::skipped;
  if (is_lod_property(tag.name)) return CityGmlThing::geometry;
  if (tag.space.starts_with(gml)) return CityGmlThing::other;
  if (is_one_of(tag.name, parts)) return CityGmlThing::part;
  if (is_one_of(tag.name, elements)) return CityGmlThing::element;
  if (is_one_of(tag.name, installations)) return CityGmlThing::installation;
  if (is_class_of_surfaces(tag.name)) return CityGmlThing::boundary;
  if (tag.name == "Window" || tag.name == "Door") return CityGmlThing::opening;
  return tag.name == "relationToConstruction" ? CityGmlThing::relation : CityGmlThing::other;
}

bool precedes_generic_attributes(const XmlTag& property) {
  if (property.space.starts_with(gml) || is_generics(property.space)) return true;
  return is_core(property.space) && is_one_of(property.name, before_generic_attributes);
}

std::string_view version_of(std::string_view space) {
  const std::string_view module = module_of(space);
  return module.substr(std::min(module.rfind('/') + 1, module.size()));
}

bool is_generics(std::string_view space) { return module_of(space).starts_with("generics/"); }

}  // namespace farlod
