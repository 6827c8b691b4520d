// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "farlod/pack.hpp"
#include "ingest/footprints/feature_tags.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::ingest {

/// The two columns of a table that hold the places of its rows.
struct PlaceColumns {
  std::size_t x = 0, y = 0;
  bool are_degrees = false;  ///< longitudes and latitudes
};

/// Finds them by their names, in capitals or not, in any order. Degrees count where a table has them beside other coordinates.
[[nodiscard]] std::optional<PlaceColumns> find_place_columns(const std::vector<std::string>& names);

/// What a field of a tree is about.
enum class TreeQuantity : std::uint8_t {
  height,
  crown_diameter,
  crown_radius,
  crown_area,
  trunk_height,
  trunk_diameter,
  trunk_girth,
  nature,  ///< OpenStreetMap's `natural`: whether it is a tree
  species,
  leaves
};

/// What a name is known for. Capitals, and all characters that are neither letters nor digits, do not count:
/// `Diameter.Breast.Height` is `diameterbreastheight`.
struct KnownTreeField {
  TreeQuantity quantity;
  LengthUnit unit = LengthUnit::metre;  ///< of numbers without a unit
  std::size_t rank = 0;                 ///< of two fields of a quantity, the one of lower rank counts
};

/// Finds what an inventory says of a tree in the fields of its table, and in the keys of OpenStreetMap's tags where a field holds
/// such. For each quantity, the first of these that has a value counts:
///   (1) the field that the settings name
///   (2) fields and keys with known names, the most specific first
/// Names are compared without regard to case.
class TreeFields {
 public:
  /// The fields that the settings name must be among the names, unless a field holds tags.
  TreeFields(const std::vector<std::string>& field_names, const TreeSettings& settings);

  /// Whether a field holds tags: what they say is known only when they are read.
  [[nodiscard]] bool holds_tags() const { return !tags_.empty(); }
  [[nodiscard]] StatedSizes of(const FieldLookup& value_of) const;

 private:
  struct Candidate {
    KnownTreeField known;
    std::optional<std::size_t> field = {};  ///< none: a key of the tags
    FieldValue value = {};
  };
  using Candidates = std::vector<Candidate>;

  void name_field(const std::vector<std::string>& names, const std::optional<std::string>& asked, TreeQuantity usual);
  void add_tags(const std::string& text, Candidates& all) const;
  [[nodiscard]] Candidates candidates(const FieldLookup& value_of) const;

  std::vector<Candidate> fields_;  ///< by rank
  std::vector<std::size_t> tags_;  ///< fields that hold tags
  std::vector<std::pair<std::string, KnownTreeField>> named_;
};

}  // namespace farlod::ingest
