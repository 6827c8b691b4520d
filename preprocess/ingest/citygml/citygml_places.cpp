// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_places.hpp"

#include <algorithm>
#include <array>

#include "ingest/citygml/citygml_vocabulary.hpp"

namespace farlod::ingest {
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
