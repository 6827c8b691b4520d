// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/footprint_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

#include "base/expects.hpp"
#include "base/lower_case.hpp"
#include "ingest/footprints/feature_tags.hpp"
#include "plausibility/stand_ins.hpp"

namespace farlod::ingest {
namespace {

constexpr double metres_in_a_foot = 0.3048;
constexpr double feet_in_an_inch = 1.0 / 12.0;

struct UnitName {
  std::string_view text;
  LengthUnit unit;
};
constexpr std::array<UnitName, 20> unit_names{
    {{"m", LengthUnit::metre},        {"m.", LengthUnit::metre},      {"metre", LengthUnit::metre},
     {"metres", LengthUnit::metre},   {"meter", LengthUnit::metre},   {"meters", LengthUnit::metre},
     {"ft", LengthUnit::foot},        {"ft.", LengthUnit::foot},      {"feet", LengthUnit::foot},
     {"foot", LengthUnit::foot},      {"'", LengthUnit::foot},        {"cm", LengthUnit::centimetre},
     {"cm.", LengthUnit::centimetre}, {"mm", LengthUnit::millimetre}, {"mm.", LengthUnit::millimetre},
     {"in", LengthUnit::inch},        {"in.", LengthUnit::inch},      {"inch", LengthUnit::inch},
     {"inches", LengthUnit::inch},    {"\"", LengthUnit::inch}}};

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size())); }

std::optional<double> take_number(std::string_view& text) {
  skip_blanks(text);
  // An approximate height is taken as it is
  if (text.starts_with('~')) text.remove_prefix(1);
  skip_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  // A comma is a decimal point, as in many countries: no height has so many metres that it needs a separator of thousands
  std::string pointed(text.substr(0, text.find_first_not_of("0123456789.,eE+-")));
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(pointed.data(), pointed.data() + pointed.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - pointed.data()));
  skip_blanks(text);
  return value;
}

std::optional<double> unit_m(std::string_view unit, LengthUnit plain) {
  if (unit.empty()) return metres_in(plain);
  const std::string lower = lower_case(std::string(unit));
  for (const UnitName& name : unit_names)
    if (lower == name.text) return metres_in(name.unit);
  return std::nullopt;
}

std::string_view without_blanks_behind(std::string_view text) { return text.substr(0, text.find_last_not_of(" \t\r\n") + 1); }

/// Whether a name ends with a unit that is no part of a word, as it is in "loft": "h_ft", "h (ft)", "hFt".
bool ends_with_unit(std::string_view name, std::string_view unit) {
  while (name.ends_with(')') || name.ends_with(']')) name.remove_suffix(1);
  if (name.size() <= unit.size() || !lower_case(name).ends_with(unit)) return false;
  const char last = name[name.size() - unit.size() - 1], first = name[name.size() - unit.size()];
  const auto is_small = [](char c) { return 'a' <= c && c <= 'z'; };
  const auto is_capital = [](char c) { return 'A' <= c && c <= 'Z'; };
  return !(is_small(last) || is_capital(last)) || (is_small(last) && is_capital(first));
}

}  // namespace

LengthUnit unit_of(std::string_view field) {
  const bool is_in_feet = ends_with_unit(field, "ft") || lower_case(field).ends_with("feet");
  return is_in_feet ? LengthUnit::foot : LengthUnit::metre;
}

double metres_in(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return 1.0;
    case LengthUnit::foot:
      return metres_in_a_foot;
    case LengthUnit::centimetre:
      return 0.01;
    case LengthUnit::millimetre:
      return 0.001;
    case LengthUnit::inch:
      break;
  }
  return feet_in_an_inch * metres_in_a_foot;
}

std::optional<double> length_m_from(std::string_view text, LengthUnit plain) {
  text = without_blanks_behind(text);
  const std::optional<double> number = take_number(text);
  if (!number) return std::nullopt;
  if (text.starts_with('\'') && text.size() > 1) {
    text.remove_prefix(1);
    const std::optional<double> inches = take_number(text);
    const bool ends_well = text.empty() || text == "\"" || text == "''";
    if (!inches || !ends_well) return std::nullopt;
    return (*number + *inches * feet_in_an_inch) * metres_in_a_foot;
  }
  const std::optional<double> unit = unit_m(text, plain);
  return unit ? std::optional(*number * *unit) : std::nullopt;
}

std::optional<double> number_from(std::string_view text) {
  text = without_blanks_behind(text);
  const std::optional<double> number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

namespace {

/// Usual names of fields with heights above the ground, the most specific first.
constexpr std::array<std::string_view, 11> height_names{"building:height", "height",  "measuredheight", "building_height",
                                                        "bldg_height",     "heightm", "height_m",       "height_ft",
                                                        "height_feet",     "hoehe",   "hauteur"};
constexpr std::array<std::string_view, 16> storeys_names{
    "building:levels", "levels",      "num_floors",         "numfloors", "number_of_floors", "floors",    "storeys",
    "stories",         "num_storeys", "storeysaboveground", "nb_etages", "nombre_d_etages",  "geschosse", "anzahl_geschosse",
    "plantas",         "pisos"};
/// The storeys inside of the roof, which `building:levels` does not count.
constexpr std::string_view levels_below_roof = "building:levels";
constexpr std::array<std::string_view, 1> roof_storeys_names{"roof:levels"};
/// The height above the ground at which an elevated part begins, such as an arch or a skyway.
constexpr std::array<std::string_view, 2> lowest_height_names{"min_height", "building:min_height"};
/// `min_level` is not among them: it numbers storeys inside of a building, and the ground is 1 in America.
constexpr std::array<std::string_view, 2> lowest_storeys_names{"building:min_level", "min_floor"};

/// The names of the fields that the settings take for something, but for one of them.
std::vector<std::string> named_besides(const FootprintSettings& s, const std::optional<std::string>& one) {
  std::vector<std::string> names;
  for (const auto* field : {&s.height_field, &s.storeys_field, &s.roof_field, &s.base_field})
    if (*field && *field != one) names.push_back(lower_case(**field));
  return names;
}

/// The fields with known names, in the order of these names, after the field that the settings name. Of two fields with the same
/// name, the first. `others` are of other things, whatever they are called.
std::vector<std::size_t> fields_called(const std::vector<std::string>& names, const std::optional<std::string>& asked,
                                       std::span<const std::string_view> known, std::span<const std::string> others = {}) {
  std::vector<std::size_t> fields;
  const auto add = [&](const auto& is_it) {
    const auto found = std::find_if(names.begin(), names.end(), is_it);
    const auto field = static_cast<std::size_t>(found - names.begin());
    if (found != names.end() && std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
  };
  if (asked) add([&](const std::string& name) { return lower_case(name) == lower_case(*asked); });
  FARLOD_EXPECTS(!asked || fields.size() == 1);
  for (const std::string_view wanted : known)
    add([&](const std::string& name) {
      return is_column_of(name, wanted) && std::find(others.begin(), others.end(), lower_case(name)) == others.end();
    });
  return fields;
}

std::string said(const std::string& name, const FieldValue& value) {
  if (!value.is_set) return name + " is empty";
  std::ostringstream text;
  text.precision(10);
  if (value.number)
    text << name << " is " << *value.number;
  else
    text << name << " is \"" << value.text << "\"";
  return std::move(text).str();
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

bool is_height(double height_m) { return 0.0 < height_m && height_m <= highest_building_m; }

/// Why walls of this height cannot be built; empty when they can.
std::optional<Unraised> objection_to(double height_m, const std::string& said) {
  if (std::abs(height_m) > highest_building_m)
    return Unraised{ProblemCode::absurd_height,
                    said + ": no building is that high; some tables write such numbers for \"unknown\""};
  if (!(height_m > 0.0)) return Unraised{ProblemCode::height_not_positive, said};
  return std::nullopt;
}

Unraised no_elevation(const std::string& said) {
  return {ProblemCode::absurd_height,
          said + ": nowhere on land is that an elevation; some tables write such numbers for \"unknown\""};
}

}  // namespace

FootprintHeights::FootprintHeights(std::vector<std::string> field_names, const FootprintSettings& settings)
    : names_(std::move(field_names)),
      default_height_m_(settings.default_height_m),
      unknown_(settings.unknown_heights),
      floor_height_m_(settings.floor_height_m),
      roof_(fields_called(names_, settings.roof_field, {})),
      base_(fields_called(names_, settings.base_field, {})),
      heights_(fields_called(names_, settings.height_field, height_names, named_besides(settings, settings.height_field))),
      storeys_(fields_called(names_, settings.storeys_field, storeys_names, named_besides(settings, settings.storeys_field))),
      lowest_heights_(fields_called(names_, {}, lowest_height_names)),
      lowest_storeys_(fields_called(names_, {}, lowest_storeys_names)),
      roof_storeys_(fields_called(names_, {}, roof_storeys_names)) {}

bool FootprintHeights::can_tell() const { return default_height_m_ || !roof_.empty() || !heights_.empty() || !storeys_.empty(); }

bool FootprintHeights::means_unknown(double number) const {
  return std::find(unknown_.begin(), unknown_.end(), number) != unknown_.end();
}

std::optional<FootprintHeights::Height> FootprintHeights::length_in(const std::vector<std::size_t>& fields,
                                                                    const FieldLookup& value_of) const {
  for (const std::size_t field : fields) {
    const FieldValue value = value_of(field);
    if (!value.is_set) continue;
    if (means_unknown(value.number ? *value.number : number_from(value.text).value_or(not_a_number))) continue;
    const LengthUnit unit = unit_of(names_[field]);
    const std::optional<double> length_m =
        value.number ? std::optional(*value.number * metres_in(unit)) : length_m_from(value.text, unit);
    if (length_m && std::isfinite(*length_m)) return Height{*length_m, said(names_[field], value), HeightSource::measured, field};
  }
  return std::nullopt;
}

std::optional<FootprintHeights::Height> FootprintHeights::storeys_in(const std::vector<std::size_t>& fields,
                                                                     const FieldLookup& value_of) const {
  for (const std::size_t field : fields) {
    const FieldValue value = value_of(field);
    if (!value.is_set) continue;
    const std::optional<double> count = value.number ? value.number : number_from(value.text);
    if (!count || !std::isfinite(*count) || means_unknown(*count)) continue;
    const bool counts_no_roof = is_column_of(names_[field], levels_below_roof) && !roof_storeys_.empty();
    const FieldValue roof = counts_no_roof ? value_of(roof_storeys_.front()) : FieldValue{};
    const double roof_count = roof.number ? *roof.number : number_from(roof.text).value_or(0.0);
    return Height{(*count + std::max(roof_count, 0.0)) * floor_height_m_, said(names_[field], value), HeightSource::storeys,
                  field};
  }
  return std::nullopt;
}

std::optional<FootprintHeights::Height> FootprintHeights::height_above_base(const FieldLookup& value_of) const {
  auto height = length_in(heights_, value_of);
  if (height && is_height(height->value_m)) return height;
  auto storeys = storeys_in(storeys_, value_of);
  if (storeys && is_height(storeys->value_m)) return storeys;
  if (default_height_m_)
    return Height{*default_height_m_, "the default height is " + std::to_string(*default_height_m_),
                  HeightSource::default_height};
  return height ? height : storeys;
}

double FootprintHeights::lowest_part_m(const FieldLookup& value_of) const {
  std::optional<Height> lowest = length_in(lowest_heights_, value_of);
  if (!lowest) lowest = storeys_in(lowest_storeys_, value_of);
  return lowest ? std::max(lowest->value_m, 0.0) : 0.0;
}

std::string FootprintHeights::what_they_say(const std::vector<std::size_t>& fields, const FieldLookup& value_of) const {
  std::string text;
  for (const std::size_t field : fields) text += (text.empty() ? "" : ", ") + said(names_[field], value_of(field));
  return text;
}

std::optional<Unraised> FootprintHeights::objection_to_base(const std::optional<Height>& base,
                                                            const FieldLookup& value_of) const {
  if (!base) return Unraised{ProblemCode::no_height, what_they_say(base_, value_of)};
  if (has_no_base_at_zero_ && base->value_m == 0.0)
    return Unraised{ProblemCode::no_height, base->said + ", and all others are far above that: it means \"unknown\""};
  if (!may_be_elevation(base->value_m)) return no_elevation(base->said);
  return std::nullopt;
}

void FootprintHeights::learn_bases(const std::vector<std::optional<float>>& bases_m) {
  auto heights_m = bases_m;
  const auto stand_ins = plausibility::take_out_stand_ins(heights_m, plausibility::HeightsOf::ground);
  has_no_base_at_zero_ = std::any_of(stand_ins.begin(), stand_ins.end(), [](const auto& s) { return s.height_m == 0.0F; });
}

std::optional<double> FootprintHeights::base_m(const FieldLookup& value_of) const {
  const auto base = length_in(base_, value_of);
  return base ? std::optional(base->value_m) : std::nullopt;
}

std::variant<PrismExtent, Unraised> FootprintHeights::below_roof(const Height& roof, const FieldLookup& value_of) const {
  if (!may_be_elevation(roof.value_m)) return no_elevation(roof.said);
  if (base_.empty()) return PrismExtent{roof.value_m - provisional_height_m, roof.value_m, HeightReference::down_to_ground};
  const std::optional<Height> base = length_in(base_, value_of);
  if (auto objection = objection_to_base(base, value_of)) return *objection;
  if (auto objection = objection_to(roof.value_m - base->value_m, roof.said + " and " + base->said)) return *objection;
  return PrismExtent{base->value_m, roof.value_m, HeightReference::elevation};
}

std::variant<PrismExtent, Unraised> FootprintHeights::above_base(const Height& height, const FieldLookup& value_of) const {
  if (auto objection = objection_to(height.value_m, height.said)) {
    if (height.field && height.value_m > highest_building_m)
      objection->too_high = SaidValue{*height.field, height.value_m, height.source};
    return *objection;
  }
  const double lowest_m = lowest_part_m(value_of);
  if (lowest_m >= height.value_m) {
    std::vector<std::size_t> lowest = lowest_heights_;
    lowest.insert(lowest.end(), lowest_storeys_.begin(), lowest_storeys_.end());
    return Unraised{ProblemCode::height_not_positive,
                    height.said + ", and it begins only above that: " + what_they_say(lowest, value_of)};
  }
  const Foot foot = lowest_m > 0.0 ? Foot::above_ground : Foot::on_ground;
  if (base_.empty()) return PrismExtent{lowest_m, height.value_m, HeightReference::on_ground, height.source, foot, height.field};
  const std::optional<Height> base = length_in(base_, value_of);
  if (auto objection = objection_to_base(base, value_of)) return *objection;
  return PrismExtent{
      base->value_m + lowest_m, base->value_m + height.value_m, HeightReference::elevation, height.source, foot, height.field};
}

std::variant<PrismExtent, Unraised> FootprintHeights::of(const FieldLookup& value_of) const {
  const auto roof = length_in(roof_, value_of),
             height = roof && may_be_elevation(roof->value_m) ? std::nullopt : height_above_base(value_of);
  if (height) return above_base(*height, value_of);
  if (roof) return below_roof(*roof, value_of);
  std::vector<std::size_t> asked = roof_;
  asked.insert(asked.end(), heights_.begin(), heights_.end());
  asked.insert(asked.end(), storeys_.begin(), storeys_.end());
  return Unraised{ProblemCode::no_height, what_they_say(asked, value_of)};
}

}  // namespace farlod::ingest
