// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// The unit of a number that is written without one.
enum class LengthUnit { metre, foot, centimetre, millimetre, inch };

[[nodiscard]] double metres_in(LengthUnit unit);

/// The unit of a column of numbers: its name ends with the unit (`h_ft`, `h (ft)`, `hFt`, `h_feet`), or it is in metres.
[[nodiscard]] LengthUnit unit_of(std::string_view field);

/// The length in a text of an attribute table, in metres: "17.5", "17,5", "17.5 m", "~17 m", "57 ft", 57', 57'6", "80 cm",
/// "6.28 inches". Empty for any other text, such as a range: a reported gap is better than a guess.
[[nodiscard]] std::optional<double> length_m_from(std::string_view text, LengthUnit plain = LengthUnit::metre);

/// The number in a text of an attribute table: "3", "2.5", "2,5", "~3". Empty for any other text.
[[nodiscard]] std::optional<double> number_from(std::string_view text);

/// The height of a building of which only the elevation of the roof is known. The base is moved to the ground later.
inline constexpr double provisional_height_m = 1.0;

/// The value of one field of a feature.
struct FieldValue {
  std::optional<double> number;  ///< if the column holds numbers
  std::string text;              ///< if it holds anything else
  bool is_set = false;
};
using FieldLookup = std::function<FieldValue(std::size_t field)>;

/// Where the height of a footprint comes from.
enum class HeightSource {
  measured,        ///< a height, or the elevation of a roof, in the table
  storeys,         ///< a number of storeys in the table
  default_height,  ///< the default height, since the table has neither
};

/// The lower and the upper end of the prism over a footprint.
struct PrismExtent {
  double base_m = 0.0, top_m = 0.0;
  HeightReference height_reference = HeightReference::on_ground;
  HeightSource source = HeightSource::measured;
  Foot foot = Foot::on_ground;
  std::optional<std::size_t> field = {};  ///< that has the height above the base, or the storeys
};

/// A height above the base as a field says it, be it impossible.
struct SaidValue {
  std::size_t field = 0;
  double value_m = 0.0;
  HeightSource source = HeightSource::measured;
};

/// Why a footprint has no prism.
struct Unraised {
  ProblemCode code;
  std::string detail;
  std::optional<SaidValue> too_high = {};
};

/// Finds the heights of footprints in the fields of their table. For each feature, the first of these that has a value counts:
///   (1) the elevation of the roof, if the settings name a field for it
///   (2) the height: the field that the settings name, then those with a known name
///   (3) the number of storeys times their height: the field that the settings name, then those with a known name
///   (4) the default height
/// A field that is empty or has no such number has no value; an elevation that lies nowhere on Earth gives way to (2) to (4); nor
/// has one with a number that means unknown: by the settings, or because no building is as high (0, -1, -9999, 99999) and a later
/// rule has another value. Names are compared without regard to case.
class FootprintHeights {
 public:
  /// The fields that the settings name must be among the names.
  FootprintHeights(std::vector<std::string> field_names, const FootprintSettings& settings);

  /// Whether there is any field with heights, or a default height.
  [[nodiscard]] bool can_tell() const;
  /// The fields with heights above the base: the one that the settings name, then the others.
  [[nodiscard]] const std::vector<std::size_t>& fields() const { return heights_; }
  [[nodiscard]] std::variant<PrismExtent, Unraised> of(const FieldLookup& value_of) const;

  /// Whether the settings name a field with elevations of bases.
  [[nodiscard]] bool has_bases() const { return !base_.empty(); }
  /// The elevation of a base, as the field has it.
  [[nodiscard]] std::optional<double> base_m(const FieldLookup& value_of) const;
  /// Learns from the bases of all features whether 0 means unknown among them, as it does among heights of a terrain.
  void learn_bases(const std::vector<std::optional<float>>& bases_m);

 private:
  struct Height {
    double value_m = 0.0;
    std::string said;  ///< the field and its value, for the report
    HeightSource source = HeightSource::measured;
    std::optional<std::size_t> field = {};
  };

  [[nodiscard]] bool means_unknown(double number) const;
  [[nodiscard]] std::optional<Height> length_in(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;
  [[nodiscard]] std::optional<Height> storeys_in(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;
  [[nodiscard]] std::optional<Height> height_above_base(const FieldLookup& value_of) const;
  [[nodiscard]] double lowest_part_m(const FieldLookup& value_of) const;
  [[nodiscard]] std::variant<PrismExtent, Unraised> below_roof(const Height& roof, const FieldLookup& value_of) const;
  [[nodiscard]] std::variant<PrismExtent, Unraised> above_base(const Height& height, const FieldLookup& value_of) const;
  [[nodiscard]] std::optional<Unraised> objection_to_base(const std::optional<Height>& base, const FieldLookup& value_of) const;
  [[nodiscard]] std::string what_they_say(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const;

  std::vector<std::string> names_;
  std::optional<double> default_height_m_;
  std::vector<double> unknown_;
  double floor_height_m_;
  std::vector<std::size_t> roof_, base_, heights_, storeys_, lowest_heights_, lowest_storeys_, roof_storeys_;
  bool has_no_base_at_zero_ = false;
};

/// Reads footprints in any vector format that GDAL knows, and builds prisms of the heights that FootprintHeights finds. Of
/// several layers, the first with areas (and with the height field that the settings name) is read; the others are reported. A
/// feature of several polygons is one building, each polygon a part of it. Elevations of vertices are ignored, unless the
/// features are bodies in space (polyhedral surfaces, or several polygons of which some are steep): bodies are read as they are.
/// Throws InputError when there is nothing to read, or when no height is known.
[[nodiscard]] SourceCity read_footprints(const InputFile& file, const FootprintSettings& settings, Report& report);

}  // namespace farlod::ingest
