// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

struct NamePair {
  std::string_view x, y;
  bool are_degrees;
};
constexpr std::array<NamePair, 12> known_pairs{{{"longitude", "latitude", true},
                                                {"lon", "lat", true},
                                                {"lng", "lat", true},
                                                {"long", "lat", true},
                                                {"x", "y", false},
                                                {"x_m", "y_m", false},
                                                {"easting", "northing", false},
                                                {"point_x", "point_y", false},
                                                {"x_coord", "y_coord", false},
                                                {"x_coordinate", "y_coordinate", false},
                                                {"rechtswert", "hochwert", false},
                                                {"ostwert", "nordwert", false}}};

}  // namespace

std::optional<PlaceColumns> find_place_columns(const std::vector<std::string>& names) {
  const auto column_of = [&](std::string_view wanted) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& n) { return lower_case(n) == wanted; });
    return static_cast<std::size_t>(found - names.begin());
  };
  for (const NamePair& pair : known_pairs) {
    const std::size_t x = column_of(pair.x), y = column_of(pair.y);
    if (x < names.size() && y < names.size()) return PlaceColumns{x, y, pair.are_degrees};
  }
  return std::nullopt;
}

namespace {

using enum TreeQuantity;
using enum LengthUnit;

struct KnownName {
  std::string_view name;
  TreeQuantity quantity;
  LengthUnit unit = metre;
};

/// The most specific first.
constexpr std::array<KnownName, 88> known_names{{
    {"htree", height},
    {"treeheight", height},
    {"treeheightm", height},
    {"totalheight", height},
    {"heightm", height},
    {"height", height},
    {"heightft", height, foot},
    {"treeheightft", height, foot},
    {"baumhoehe", height},
    {"baumhöhe", height},
    {"hoehe", height},
    {"höhe", height},
    {"hauteur", height},
    {"hauteurm", height},
    {"hauteurenm", height},
    {"boomhoogte", height},
    {"altura", height},
    {"estheight", height},
    {"dcrown", crown_diameter},
    {"crowndiameter", crown_diameter},
    {"crowndiameterm", crown_diameter},
    {"diametercrown", crown_diameter},
    {"kronendurchmesser", crown_diameter},
    {"kronedurch", crown_diameter},
    {"kronedm", crown_diameter},
    {"crownwidth", crown_diameter},
    {"crownwidthm", crown_diameter},
    {"crownspread", crown_diameter},
    {"canopydiameter", crown_diameter},
    {"canopywidth", crown_diameter},
    {"canopyspread", crown_diameter},
    {"kroondiameter", crown_diameter},
    {"crown", crown_diameter},
    {"crowndiameterft", crown_diameter, foot},
    {"crownradius", crown_radius},
    {"rcrown", crown_radius},
    {"kronenradius", crown_radius},
    {"canopym2", crown_area},
    {"canopyaream2", crown_area},
    {"canopyarea", crown_area},
    {"crownm2", crown_area},
    {"crownaream2", crown_area},
    {"crownarea", crown_area},
    {"kronenflaeche", crown_area},
    {"htrunk", trunk_height},
    {"trunkheight", trunk_height},
    {"trunkheightm", trunk_height},
    {"crownbase", trunk_height},
    {"crownbaseheight", trunk_height},
    {"heighttocrownbase", trunk_height},
    {"stammhoehe", trunk_height},
    {"kronenansatz", trunk_height},
    {"dbh", trunk_diameter, centimetre},
    {"dbhcm", trunk_diameter, centimetre},
    {"diameterbreastheight", trunk_diameter, centimetre},
    {"trunkdiameter", trunk_diameter, centimetre},
    {"trunkdiametercm", trunk_diameter, centimetre},
    {"stammdurch", trunk_diameter, centimetre},
    {"stammdurchmesser", trunk_diameter, centimetre},
    {"bhd", trunk_diameter, centimetre},
    {"treedbh", trunk_diameter, inch},
    {"dbhin", trunk_diameter, inch},
    {"dbhinches", trunk_diameter, inch},
    {"diameterin", trunk_diameter, inch},
    {"stammumfg", trunk_girth, centimetre},
    {"stammumfang", trunk_girth, centimetre},
    {"trunkcircumference", trunk_girth, centimetre},
    {"circumferencecm", trunk_girth, centimetre},
    {"circonference", trunk_girth, centimetre},
    {"circonferenceencm", trunk_girth, centimetre},
    {"girth", trunk_girth, centimetre},
    {"umfang", trunk_girth, centimetre},
    // OpenStreetMap counts in metres
    {"circumference", trunk_girth},
    {"natural", nature},
    {"leafcycle", leaves},
    {"genus", species},
    {"gattung", species},
    {"species", species},
    {"speciesen", species},
    {"specieslat", species},
    {"scientificname", species},
    {"botanicalname", species},
    {"artbot", species},
    {"speciesname", species},
    {"taxon", species},
    {"commonname", species},
    {"baumart", species},
    {"leaftype", leaves},
}};

/// Letters in lower case, and digits. Bytes of letters beyond ASCII stay.
std::string normalized(const std::string& name) {
  std::string result = lower_case(name);
  std::erase_if(result, [](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
    return !is_letter && (c < '0' || c > '9');
  });
  return result;
}

bool is_name_of_tags(const std::string& name) {
  const std::string is = normalized(name);
  return is == "tags" || is == "othertags" || is == "alltags";
}

std::optional<double> length_m(const FieldValue& value, LengthUnit unit) {
  const auto length = value.number ? std::optional(*value.number * metres_in(unit)) : length_m_from(value.text, unit);
  return length && std::isfinite(*length) ? length : std::nullopt;
}

std::optional<double> plain_number(const FieldValue& value) {
  const auto number = value.number ? value.number : number_from(value.text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

double diameter_of_area(double area_m2) { return area_m2 < 0.0 ? area_m2 : 2.0 * std::sqrt(area_m2 / std::numbers::pi); }

/// A girth of more metres than any trunk has was written in centimetres, whatever the unit should be.
double diameter_of_girth(double girth_m) {
  constexpr double largest_girth_m = 20.0;
  return (girth_m > largest_girth_m ? 0.01 * girth_m : girth_m) / std::numbers::pi;
}

/// What a field says of a length, in metres: of an area or a girth, the diameter.
std::optional<double> size_m(const KnownTreeField& known, const FieldValue& value) {
  if (known.quantity == crown_area) {
    const auto area_m2 = plain_number(value);
    return area_m2 ? std::optional(diameter_of_area(*area_m2)) : std::nullopt;
  }
  const auto length = length_m(value, known.unit);
  if (!length) return std::nullopt;
  if (known.quantity == trunk_girth) return diameter_of_girth(*length);
  return known.quantity == crown_radius ? 2.0 * *length : *length;
}

std::optional<double>& size_of(StatedSizes& sizes, TreeQuantity quantity) {
  if (quantity == height) return sizes.height_m;
  if (quantity == trunk_height) return sizes.trunk_height_m;
  return quantity == trunk_diameter || quantity == trunk_girth ? sizes.trunk_diameter_m : sizes.crown_diameter_m;
}

/// Adds what a field says to what others have said before it.
void take(StatedSizes& sizes, const KnownTreeField& known, const FieldValue& value) {
  if (known.quantity == nature) {
    sizes.is_tree = value.text.empty() || value.text == "tree";
  } else if (known.quantity == leaves || known.quantity == species) {
    if (sizes.foliage == Foliage::unknown)
      sizes.foliage = known.quantity == leaves ? foliage_of_leaves(value.text) : foliage_of_species(value.text);
  } else if (std::optional<double>& size = size_of(sizes, known.quantity); !size) {
    size = size_m(known, value);
  }
}

std::optional<KnownTreeField> known_tree_field(const std::string& name) {
  const std::string is = normalized(name);
  const auto found =
      std::find_if(known_names.begin(), known_names.end(), [&](const KnownName& known) { return known.name == is; });
  if (found == known_names.end()) return std::nullopt;
  // Rank 0 is that of fields that the settings name
  return KnownTreeField{found->quantity, found->unit, static_cast<std::size_t>(found - known_names.begin()) + 1};
}

}  // namespace

TreeFields::TreeFields(const std::vector<std::string>& field_names, const TreeSettings& settings) {
  for (std::size_t n = 0; n < field_names.size(); ++n) {
    if (is_name_of_tags(field_names[n])) tags_.push_back(n);
    if (const auto known = known_tree_field(field_names[n])) fields_.push_back({*known, n});
  }
  name_field(field_names, settings.height_field, height);
  name_field(field_names, settings.crown_field, crown_diameter);
  name_field(field_names, settings.trunk_field, trunk_height);
  std::stable_sort(fields_.begin(), fields_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.known.rank < b.known.rank; });
}

/// A name that is known for another quantity of the same part of a tree is one of that: an area of a crown, a trunk's girth.
void TreeFields::name_field(const std::vector<std::string>& names, const std::optional<std::string>& asked, TreeQuantity usual) {
  if (!asked) return;
  const auto part_of = [](TreeQuantity q) {
    if (q == height) return 0;
    return q == crown_diameter || q == crown_radius || q == crown_area ? 1 : 2;
  };
  KnownTreeField field{usual};
  if (const auto known = known_tree_field(*asked))
    if (known->quantity < nature && part_of(known->quantity) == part_of(usual)) field = *known;
  field.rank = 0;
  const std::string wanted = lower_case(*asked);
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const std::string& name) { return lower_case(name) == wanted; });
  if (found != names.end()) fields_.push_back({field, static_cast<std::size_t>(found - names.begin())});
  named_.emplace_back(wanted, field);
}

void TreeFields::add_tags(const std::string& text, Candidates& all) const {
  Tags tags = tags_in(text);
  for (auto& [key, value] : tags) {
    const auto is_key = [lower = lower_case(key)](const auto& named) { return named.first == lower; };
    const auto named = std::find_if(named_.begin(), named_.end(), is_key);
    const auto known = named != named_.end() ? std::optional(named->second) : known_tree_field(key);
    if (known) all.push_back({*known, std::nullopt, {std::nullopt, std::move(value), true}});
  }
  const auto says_nature = [](const Candidate& c) { return c.known.quantity == nature && c.value.is_set; };
  if (!tags.empty() && std::none_of(all.begin(), all.end(), says_nature))
    all.push_back({{nature}, std::nullopt, {std::nullopt, "nothing", true}});
}

TreeFields::Candidates TreeFields::candidates(const FieldLookup& value_of) const {
  Candidates all;
  for (const Candidate& field : fields_) all.push_back({field.known, field.field, value_of(*field.field)});
  if (tags_.empty()) return all;
  for (const std::size_t field : tags_) add_tags(value_of(field).text, all);
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.known.rank < b.known.rank; });
  return all;
}

StatedSizes TreeFields::of(const FieldLookup& value_of) const {
  StatedSizes sizes;
  for (const Candidate& candidate : candidates(value_of))
    if (candidate.value.is_set) take(sizes, candidate.known, candidate.value);
  return sizes;
}

}  // namespace farlod::ingest
