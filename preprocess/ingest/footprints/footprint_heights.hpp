// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "city/city_model.hpp"
#include "city/problem.hpp"
#include "ingest/footprints/footprint_settings.hpp"

namespace farlod::ingest {

/// How far below its roof a building ends of which only the elevation of the roof is known, until the ground is known.
inline constexpr double provisional_height_m = 1.0;

/// What a feature says in one field of its table.
struct FieldValue {
  std::optional<double> number;  ///< where the column holds numbers
  std::string text;              ///< where it holds anything else
  bool is_set = false;
};
using FieldLookup = std::function<FieldValue(std::size_t field)>;

/// Who says how high a footprint is.
enum class HeightSource {
  measured,        ///< the table: a height, or the elevation of a roof
  storeys,         ///< the table, in storeys
  default_height,  ///< the user, for all that the table knows nothing of
};

/// From where to where a footprint is raised.
struct PrismExtent {
  double base_m = 0.0, top_m = 0.0;
  HeightReference height_reference = HeightReference::on_ground;
  HeightSource source = HeightSource::measured;
};

/// Why a footprint is not raised.
struct Unraised {
  ProblemCode code;
  std::string detail;
};

/// Knows which fields of a table of footprints say how high they are. For each feature, the first that says something counts:
///   (1) the elevation of the roof, if a field for it was asked for
///   (2) the height: the field asked for, then those with a known name
///   (3) the number of storeys times their height: the field asked for, then those with a known name
///   (4) the default height
/// A field that is empty or holds no such number says nothing. Names are compared whatever the case.
class FootprintHeights {
 public:
  /// Fields that the settings ask for are among the names.
  FootprintHeights(std::vector<std::string> field_names, const FootprintSettings& settings);

  /// Whether features can say how high they are at all.
  [[nodiscard]] bool can_tell() const;
  [[nodiscard]] std::variant<PrismExtent, Unraised> of(const FieldLookup& value_of) const;

 private:
  struct Height {
    double value_m = 0.0;
    std::string said;  ///< as the feature has it, for the report
    HeightSource source = HeightSource::measured;
  };

  [[nodiscard]] std::optional<Height> length_in(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;
  [[nodiscard]] std::optional<Height> storeys_in(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;
  [[nodiscard]] std::optional<Height> height_above_base(const FieldLookup& value_of) const;
  [[nodiscard]] double lowest_part_m(const FieldLookup& value_of) const;
  [[nodiscard]] std::variant<PrismExtent, Unraised> below_roof(const Height& roof, const FieldLookup& value_of) const;
  [[nodiscard]] std::variant<PrismExtent, Unraised> above_base(const Height& height, const FieldLookup& value_of) const;
  [[nodiscard]] std::string what_they_say(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;

  std::vector<std::string> names_;
  std::optional<double> default_height_m_;
  double floor_height_m_;
  std::vector<std::size_t> roof_, base_, heights_, storeys_, lowest_heights_, lowest_storeys_;
};

}  // namespace farlod::ingest
