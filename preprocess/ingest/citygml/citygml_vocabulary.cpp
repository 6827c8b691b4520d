// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_vocabulary.hpp"

#include <algorithm>
#include <array>

#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {
namespace {

constexpr std::string_view gml = "http://www.opengis.net/gml";
constexpr std::string_view citygml = "http://www.opengis.net/citygml/";

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

namespace {

constexpr std::size_t longest_name = 200;

/// The first characters. The cut is not inside a UTF-8 character, which could not be written as JSON.
std::string beginning_of(std::string_view text) {
  if (text.size() <= longest_name) return std::string(text);
  std::size_t end = longest_name;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace

void SkippedCount::add(const XmlElement& element) {
  std::string name = beginning_of(element.name);
  if (vocabulary_of(element.space) == Vocabulary::foreign && !element.space.empty())
    name += " (" + beginning_of(element.space) + ")";
  const bool is_told_apart = counts_.size() < most_names || counts_.contains(name);
  ++counts_[is_told_apart ? name : other_names];
}

bool SkippedCount::append(const SkippedCount& next) {
  for (const auto& [name, count] : next.counts_) counts_[name] += count;
  return counts_.size() <= most_names && !counts_.contains(other_names);
}

namespace {

constexpr std::string_view citygml_space = "http://www.opengis.net/citygml/", generics_module = "generics/";

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

/// Behind the beginning that all namespaces of CityGML share.
std::string_view module_of(std::string_view space) {
  return space.starts_with(citygml_space) ? space.substr(citygml_space.size()) : "";
}

bool precedes_generic_attributes(const XmlElement& property) {
  const Vocabulary vocabulary = vocabulary_of(property.space);
  if (vocabulary == Vocabulary::gml || module_of(property.space).starts_with(generics_module)) return true;
  return vocabulary == Vocabulary::core &&
         std::ranges::find(before_generic_attributes, property.name) != before_generic_attributes.end();
}

/// A prefix for a namespace, and its declaration where the file has none.
struct Prefix {
  std::string with_colon, declaration;
};

Prefix prefix_or(const std::optional<std::string>& known, const std::string& own, const std::string& space) {
  if (!known) return {own + ":", " xmlns:" + own + "=\"" + space + "\""};
  return {known->empty() ? "" : *known + ":", ""};
}

package::AttributeForm form_of_version_2(const Prefix& generics) {
  const std::string attribute = generics.with_colon + "doubleAttribute", value = generics.with_colon + "value";
  return {.before_all = "",
          .before_name = "<" + attribute + generics.declaration + " name=\"",
          .before_value = "\"><" + value + ">",
          .behind_value = "</" + value + "></" + attribute + ">",
          .between = "",
          .behind_all = ""};
}

package::AttributeForm form_of_version_3(const Prefix& core, const Prefix& generics) {
  const std::string property = core.with_colon + "genericAttribute", attribute = generics.with_colon + "DoubleAttribute";
  const std::string name = generics.with_colon + "name", value = generics.with_colon + "value";
  return {.before_all = "",
          .before_name = "<" + property + core.declaration + "><" + attribute + generics.declaration + "><" + name + ">",
          .before_value = "</" + name + "><" + value + ">",
          .behind_value = "</" + value + "></" + attribute + "></" + property + ">",
          .between = "",
          .behind_all = ""};
}

/// Expat hands out UTF-8, and the file may have another encoding.
bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80U; });
}

}  // namespace

void CityGmlPlaces::start(const XmlElement& element) {
  ++depth_;
  if (!is_in_property()) return;
  Open& object = open_.back();
  object.is_before = !object.has_later_property && precedes_generic_attributes(element);
  object.has_later_property = !object.is_before;
}

void CityGmlPlaces::end(std::uint64_t end) {
  if (is_in_property() && open_.back().is_before && open_.back().place.form != 0) open_.back().place.at = end;
  --depth_;
}

void CityGmlPlaces::open(const XmlElement& element) {
  Open& object = open_.emplace_back();
  object.depth = depth_;
  if (!known_ || known_->first != element.space) known_ = {std::string(element.space), form_number_of(element.space)};
  if (known_->second != 0) object.place = {element.end, known_->second};
}

std::uint32_t CityGmlPlaces::form_number_of(std::string_view space) {
  const std::optional<package::AttributeForm> form = form_of(space);
  if (!form) return 0;
  const auto found = std::ranges::find(forms_, *form);
  const auto number = static_cast<std::uint32_t>(found - forms_.begin()) + 1;
  if (found == forms_.end()) forms_.push_back(*form);
  return number;
}

package::AttributePlace CityGmlPlaces::close() {
  const package::AttributePlace place = open_.back().place;
  open_.pop_back();
  return place;
}

bool CityGmlPlaces::append(const CityGmlPlaces& next) {
  if (forms_.empty()) forms_ = next.forms_;
  return next.forms_.size() <= forms_.size() && std::equal(next.forms_.begin(), next.forms_.end(), forms_.begin());
}

std::optional<package::AttributeForm> CityGmlPlaces::form_of(std::string_view space) const {
  const std::string_view module = module_of(space);
  const std::string version(module.substr(std::min(module.rfind('/') + 1, module.size())));
  const std::string space_of_generics = std::string(citygml_space).append(generics_module) + version;
  const Prefix generics = prefix_or(prefix_of(space_of_generics), "gen", space_of_generics);
  if (version == "1.0" || version == "2.0") return form_of_version_2(generics);
  const std::string core = std::string(citygml_space) + version;
  if (version == "3.0") return form_of_version_3(prefix_or(prefix_of(core), "core", core), generics);
  return std::nullopt;
}

std::optional<std::string> CityGmlPlaces::prefix_of(std::string_view space) const {
  for (auto binding = bindings_.rbegin(); binding != bindings_.rend(); ++binding) {
    const auto is_same_prefix = [&](const auto& later) { return later.first == binding->first; };
    if (binding->second == space && is_ascii(binding->first) && std::none_of(bindings_.rbegin(), binding, is_same_prefix))
      return binding->first;
  }
  return std::nullopt;
}

}  // namespace farlod::ingest
