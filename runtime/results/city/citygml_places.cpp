// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_places.hpp"

#include <algorithm>

#include "results/city/citygml_names.hpp"

namespace farlod {
namespace {

/// The name of a generic attribute of CityGML 3.0 is in an element within two others: genericAttribute/DoubleAttribute/name.
constexpr std::size_t levels_to_name = 3;

/// A prefix for a namespace, and its declaration where the file has none.
struct Prefix {
  std::string with_colon, declaration;
};

Prefix prefix_or(const std::optional<std::string>& known, const std::string& own, const std::string& space) {
  if (!known) return {own + ":", " xmlns:" + own + "=\"" + space + "\""};
  return {known->empty() ? "" : *known + ":", ""};
}

GenericAttributeForm form_of_version_2(const Prefix& generics) {
  const std::string attribute = generics.with_colon + "doubleAttribute", value = generics.with_colon + "value";
  return {"<" + attribute + generics.declaration + " name=\"", "\"><" + value + ">", "</" + value + "></" + attribute + ">"};
}

GenericAttributeForm form_of_version_3(const Prefix& core, const Prefix& generics) {
  const std::string property = core.with_colon + "genericAttribute", attribute = generics.with_colon + "DoubleAttribute";
  const std::string name = generics.with_colon + "name", value = generics.with_colon + "value";
  return {"<" + property + core.declaration + "><" + attribute + generics.declaration + "><" + name + ">",
          "</" + name + "><" + value + ">", "</" + value + "></" + attribute + "></" + property + ">"};
}

}  // namespace

void CityGmlPlaces::start(const XmlTag& tag) {
  ++depth_;
  if (is_inside(1)) {
    Open& object = open_.back();
    object.is_before = !object.has_later_property && precedes_generic_attributes(tag);
    object.has_later_property = !object.is_before;
    if (is_generics(tag.space)) object.names.emplace_back(tag.attribute_name);
  }
  in_name_ = is_inside(levels_to_name) && tag.name == "name" && is_generics(tag.space);
  if (in_name_) name_.clear();
}

void CityGmlPlaces::text(std::string_view piece) {
  if (in_name_) name_ += piece;
}

void CityGmlPlaces::end(std::size_t end) {
  if (in_name_) open_.back().names.push_back(name_);
  in_name_ = false;
  if (is_inside(1) && open_.back().is_before && open_.back().place) open_.back().place->at = end;
  --depth_;
}

void CityGmlPlaces::open(const XmlTag& tag) {
  Open& object = open_.emplace_back();
  object.depth = depth_;
  const std::optional<GenericAttributeForm> form = form_of(tag.space);
  if (!form) return;
  const auto known = std::ranges::find(forms_, *form);
  object.place = {tag.end, static_cast<std::size_t>(known - forms_.begin())};
  if (known == forms_.end()) forms_.push_back(*form);
}

ClosedPlace CityGmlPlaces::close() {
  ClosedPlace closed{open_.back().place, std::move(open_.back().names)};
  open_.pop_back();
  return closed;
}

std::optional<GenericAttributeForm> CityGmlPlaces::form_of(std::string_view space) const {
  const std::string version(version_of(space)), citygml = "http://www.opengis.net/citygml/";
  const std::string space_of_generics = citygml + "generics/" + version, core = citygml + version;
  const Prefix generics = prefix_or(prefix_of(space_of_generics), "gen", space_of_generics);
  if (version == "1.0" || version == "2.0") return form_of_version_2(generics);
  if (version == "3.0") return form_of_version_3(prefix_or(prefix_of(core), "core", core), generics);
  return std::nullopt;
}

std::optional<std::string> CityGmlPlaces::prefix_of(std::string_view space) const {
  for (auto binding = bindings_.rbegin(); binding != bindings_.rend(); ++binding) {
    const auto is_same_prefix = [&](const auto& later) { return later.first == binding->first; };
    if (binding->second == space && std::none_of(bindings_.rbegin(), binding, is_same_prefix)) return binding->first;
  }
  return std::nullopt;
}

}  // namespace farlod
