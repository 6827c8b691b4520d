// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/feature_tags.hpp"

#include <algorithm>
#include <array>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

bool has_any(const std::vector<std::string>& names, std::initializer_list<std::string_view> wanted) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::any_of(wanted.begin(), wanted.end(), [&](std::string_view known) { return is_column_of(name, known); });
  });
}

bool any_says(const std::vector<TagLookup>& some, const std::function<bool(const TagLookup&)>& says) {
  return std::any_of(some.begin(), some.end(), says);
}

/// Whether a feature has one of the keys that most areas of OpenStreetMap have.
bool has_main_key(const TagLookup& tag) {
  constexpr std::array<std::string_view, 8> keys{"building", "building:part", "landuse", "natural",
                                                 "leisure",  "amenity",       "highway", "demolished:building"};
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return tag(key).has_value(); });
}

/// Values of `building` that say that there is none, or not any more, or not yet; and what programs write for no value.
bool is_denied(const std::string& value) {
  constexpr std::array<std::string_view, 12> denials{"no",       "demolished", "razed",     "removed", "destroyed", "false",
                                                     "proposed", "planned",    "collapsed", "none",    "null",      "nan"};
  return value.empty() || std::find(denials.begin(), denials.end(), lower_case(value)) != denials.end();
}

bool is_true(const std::optional<std::string>& value) { return value && (lower_case(*value) == "true" || *value == "1"); }

bool is_affirmed(const std::optional<std::string>& value) { return value && !is_denied(*value); }

bool is_underground(const TagLookup& tag) {
  const auto location = tag("location"), layer = tag("layer");
  return location == "underground" || (layer && layer->starts_with('-')) || is_true(tag("is_underground"));
}

/// Overture's table of parts, which has no column that buildings alone have.
bool is_of_parts(const std::vector<std::string>& names) {
  return has_any(names, {"building_id"}) && has_any(names, {"roof_shape", "facade_material", "min_floor"});
}

}  // namespace

BuildingTags::BuildingTags(const std::vector<std::string>& names, const std::vector<TagLookup>& some)
    : are_of_overture_(has_any(names, {"has_parts", "is_underground"}) || is_of_parts(names)) {
  // Others have a column "tags", too
  const bool has_collection =
      has_any(names, {"other_tags", "all_tags"}) || (has_any(names, {"tags"}) && any_says(some, has_main_key));
  const bool has_key = has_collection || has_any(names, {"building", "building:part"});
  const bool has_ids = has_collection || has_any(names, {"osm_id", "osm_way_id", "@id", "@osm_id", "full_id", "osm_type"});
  const bool says_yes =
      any_says(some, [](const TagLookup& tag) { return tag("building") == "yes" || tag("building:part") == "yes"; });
  are_known_ = are_of_overture_ || (has_key && (has_ids || says_yes));
  const bool has_part_column = has_any(names, {"building:part"}) || (are_of_overture_ && has_any(names, {"building_id", "type"}));
  may_have_parts_ = are_known_ && (has_collection || has_part_column);
}

FeatureRole BuildingTags::role_of(const TagLookup& tag) const {
  if (!are_known_) return FeatureRole::building;
  if (is_underground(tag)) return FeatureRole::underground;
  if (is_affirmed(tag("building:part"))) return FeatureRole::part;
  if (are_of_overture_) return tag("building_id") || tag("type") == "building_part" ? FeatureRole::part : FeatureRole::building;
  return is_affirmed(tag("building")) ? FeatureRole::building : FeatureRole::no_building;
}

bool is_column_of(std::string_view column, std::string_view known) {
  constexpr std::size_t longest_in_shapefiles = 10;
  std::string name = lower_case(std::string(column)), wanted(known);
  std::replace(name.begin(), name.end(), ':', '_');
  std::replace(wanted.begin(), wanted.end(), ':', '_');
  if (name == wanted) return true;
  // building_m may be the material of a building; number_of_ may count anything
  const std::string cut = wanted.substr(0, longest_in_shapefiles);
  return name.size() == longest_in_shapefiles && name == cut && !cut.ends_with('_') && !wanted.starts_with("building_min");
}

const std::vector<std::string>& known_tags() {
  static const std::vector<std::string> tags{
      "building",        "building:part",      "height",   "building:height", "min_height",
      "building:levels", "building:min_level", "location", "layer",           "roof:levels"};
  return tags;
}

}  // namespace farlod::ingest
