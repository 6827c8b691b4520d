// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace farlod::ingest {

/// Keys with their values.
using Tags = std::vector<std::pair<std::string, std::string>>;

/// The tags in a field of OpenStreetMap's data: an object of JSON, {"natural": "tree"}, or a list, "natural"=>"tree". Values that
/// are neither texts nor numbers are left out; of any other text there are none.
[[nodiscard]] Tags tags_in(const std::string& text);

/// What a feature is among those of OpenStreetMap or Overture.
enum class FeatureRole {
  building,
  part,  ///< of a building, whose outline has a feature of its own
  underground,
  no_building  ///< land use, water, a demolished building …
};

/// The value of a tag of a feature; empty where it has none.
using TagLookup = std::function<std::optional<std::string>(std::string_view tag)>;

/// Tells the features of a table of OpenStreetMap or Overture apart, as their wikis define the tags: "Key:building", "Simple 3D
/// Buildings", and the schema of Overture's theme "buildings".
class BuildingTags {
 public:
  /// Names of the table's fields. `some` are features of it.
  BuildingTags(const std::vector<std::string>& field_names, const std::vector<TagLookup>& some);

  /// Whether the table is one of OpenStreetMap or Overture. All features of another one are buildings.
  [[nodiscard]] bool are_known() const { return are_known_; }
  /// Whether a feature of it can be a part.
  [[nodiscard]] bool may_have_parts() const { return may_have_parts_; }
  [[nodiscard]] FeatureRole role_of(const TagLookup& tag) const;

 private:
  bool are_known_ = false, are_of_overture_ = false, may_have_parts_ = false;
};

/// Fields that hold further tags of a feature, as GDAL's driver for OpenStreetMap and osm2pgsql write them.
inline constexpr std::string_view tag_collections[] = {"other_tags", "all_tags", "tags"};

/// Whether a column holds what is known by this name, such as `building:levels`: it has the name, in capitals or not, or the name
/// as databases and Shapefiles write it: with `_` for `:` (building_levels), and cut to ten characters (building_l). No name is
/// cut where two different things would have the same one.
[[nodiscard]] bool is_column_of(std::string_view column, std::string_view known);

/// The tags that the heights and roles of buildings are found in, by name.
[[nodiscard]] const std::vector<std::string>& known_tags();

}  // namespace farlod::ingest
