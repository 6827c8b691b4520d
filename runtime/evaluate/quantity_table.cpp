// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/quantity_table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>

#include "evaluate/crown_columns.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/view_columns.hpp"
#include "farlod/shadow_patches.hpp"
#include "radiation/light_table.hpp"

namespace farlod {
namespace {

using Columns = std::vector<ColumnDescription>;

/// Asked for by a flag, with one column or a few.
template <bool Quantities::*Flag>
constexpr auto is_flagged = [](const Quantities& q) { return q.*Flag; };
template <bool Quantities::*Flag>
constexpr auto set_flag = [](Quantities& q) { q.*Flag = true; };

void describe_solid(const Quantities&, Columns& columns) {
  columns.push_back({"svf_solid", "1", "share of the solid angle of the sky that the receiver sees"});
}

void describe_directional(const Quantities&, Columns& columns) {
  for (const auto& [letter, half] : words_of_halves)
    columns.push_back(
        {std::string("svf") + letter, "1", std::string("sky view factor of the ") + half + " half of the sky, twice its share"});
}

void describe_hidden(const Quantities&, Columns& columns) {
  columns.push_back({"hidden_near", "1", "share of the sky that geometry of the neighborhood hides"});
  columns.push_back({"hidden_far", "1", "share of the sky that geometry beyond the neighborhood alone hides"});
}

/// Degrees with as few decimals as tell the azimuths apart: 000, 010 or 000.00, 007.50.
std::string azimuth_name(std::size_t n, std::size_t count) {
  std::array<char, 32> text{};
  const double degrees = 360.0 * static_cast<double>(n) / static_cast<double>(count);
  std::snprintf(text.data(), text.size(), 360 % count == 0 ? "%03.0f" : "%06.2f", degrees);
  return text.data();
}

void describe_horizons(const Quantities& q, Columns& columns) {
  for (std::size_t n = 0; n < q.horizons; ++n) {
    const std::string azimuth = azimuth_name(n, q.horizons);
    columns.push_back({"horizon_" + azimuth, "degree",
                       "elevation above which all is sky, at " + azimuth + " degrees clockwise from true north"});
  }
}

void describe_distances(const Quantities& q, Columns& columns) {
  for (std::size_t n = 0; n < q.horizons; ++n) {
    const std::string azimuth = azimuth_name(n, q.horizons);
    columns.push_back({"distance_" + azimuth, "m",
                       "level distance to what makes the horizon at " + azimuth + " degrees clockwise from true north"});
  }
}

std::size_t patches_of(SkyPatchSet set) {
  const PatchBands bands = patch_bands_of(set);
  return bands.counts.empty() ? 0 : std::accumulate(bands.counts.begin(), bands.counts.end(), std::size_t{1});
}

void describe_patches(const Quantities& q, Columns& columns) {
  constexpr std::size_t digits = 3;
  for (std::size_t n = 1; n <= patches_of(q.sky_patches); ++n) {
    std::string number = std::to_string(n);
    number.insert(0, digits - std::min(digits, number.size()), '0');
    columns.push_back(
        {"patch_" + number, "1", "share that is seen of patch " + number + " of the sky, weighted by the cosine to the normal"});
  }
}

void describe_sunlit(const Quantities&, Columns& columns) {
  columns.push_back(
      {"sunlit_h", "h", "hours at which the middle of the sun is seen, were the sky clear; days are those of local mean time"});
}

void describe_sunlit_total(const Quantities&, Columns& columns) {
  columns.push_back(
      {"sunlit_total_h", "h",
       "hours of sunshine past the crowns of trees and through them, were the sky clear; days are those of local mean time"});
}

void describe_shadow_patches(const Quantities&, Columns& columns) {
  const std::array<std::pair<const char*, const char*>, shadow_matrix_count> matrices{
      {{"shadow_", "nothing solid hides"},
       {"vegshadow_", "no crown hides sky in"},
       {"vbshadow_", "no crown hides solid things in"}}};
  for (const auto& [name, meaning] : matrices)
    for (std::size_t n = 0; n < columns_of_shadow_matrix; ++n)
      columns.push_back({name + std::to_string(n + 1), "1",
                         "a whole number whose bits, from the least on, are 1 where " + std::string(meaning) + " patch " +
                             std::to_string(n * patches_of_shadow_column) + " and the following ones of the 153 of UMEP"});
}

void describe_irradiation(const Quantities& q, Columns& columns) {
  const std::string unit = "kW h m-2";
  columns.push_back({"irradiation", unit, "what falls on the receiver in the period: the sum of the next three"});
  columns.push_back({"irradiation_direct", unit, "what comes from the sun"});
  columns.push_back({"irradiation_diffuse", unit, "what comes from the sky"});
  columns.push_back({"irradiation_reflected", unit, "what the ground and facades reflect, once"});
  if (!q.light) return;
  for (const unsigned month : months_by_name(*q.light)) {
    const std::string number = (month < 10 ? "0" : "") + std::to_string(month);
    columns.push_back({"irradiation_" + number, unit, "irradiation in month " + number});
  }
}

void describe_irradiance(const Quantities&, Columns& columns) {
  columns.push_back({"irradiance", "W m-2", "mean of what falls on the receiver in the period, by day and by night"});
}

void describe_illuminance(const Quantities&, Columns& columns) {
  columns.push_back({"illuminance", "lx", "mean of the light to the eye in the period, by day and by night"});
}

void describe_shade(const Quantities& q, Columns& columns) {
  columns.push_back({"shade", "1", "share of the period's hours of sun in which none shines on the receiver"});
  if (!q.light || !q.light->by_step) return;
  for (const LightInterval& interval : q.light->intervals)
    if (has_sun(interval))
      columns.push_back({"shade_" + begin_text_of(interval), "1", "shade from " + begin_text_of(interval) + " on"});
}

void describe_sky_component(const Quantities&, Columns& columns) {
  columns.push_back(
      {"sky_component", "1", "light of the overcast sky of the CIE, as a share of that on a level plane in the open"});
}

constexpr std::size_t usual_horizons = 36;

void ask_for_horizons(Quantities& q) {
  if (q.horizons == 0) q.horizons = usual_horizons;
}

void ask_for_sun(Quantities& q) {
  if (!q.sun) q.sun.emplace();
}

constexpr auto table = std::to_array<QuantityRow>({
    {.quantity = Quantity::svf_solid,
     .word = {.word = "svf_solid", .meaning = "share of the solid angle"},
     .is_asked = is_flagged<&Quantities::svf_solid>,
     .ask = set_flag<&Quantities::svf_solid>,
     .describe = describe_solid,
     .add = &FurtherQuantities::add_solid},
    {.quantity = Quantity::directional,
     .word = {.word = "directional", .meaning = "svfN, svfE, svfS, svfW as UMEP has them"},
     .is_asked = is_flagged<&Quantities::directional>,
     .ask = set_flag<&Quantities::directional>,
     .describe = describe_directional,
     .add = &FurtherQuantities::add_directional},
    {.quantity = Quantity::hidden,
     .word = {.word = "hidden", .meaning = "by near and by far geometry"},
     .is_asked = is_flagged<&Quantities::hidden>,
     .ask = set_flag<&Quantities::hidden>,
     .describe = describe_hidden,
     .add = &FurtherQuantities::add_hidden},
    {.quantity = Quantity::horizon,
     .word = {.word = "horizon", .meaning = "its elevations, at 36 azimuths", .is_weighted = false},
     .is_asked = [](const Quantities& q) { return q.horizons > 0; },
     .ask = ask_for_horizons,
     .describe = describe_horizons,
     .add = &FurtherQuantities::add_horizons},
    {.quantity = Quantity::horizon_distance,
     .word = {.word = "horizon_distance", .meaning = "with the level distance to it", .is_weighted = false},
     .is_asked = [](const Quantities& q) { return q.horizon_distances; },
     .ask =
         [](Quantities& q) {
           ask_for_horizons(q);
           q.horizon_distances = true;
         },
     .describe = describe_distances,
     .add = &FurtherQuantities::add_distances},
    {.quantity = Quantity::sky_patches,
     .word = {.word = "sky_patches", .meaning = "the share seen of each of 145"},
     .is_asked = [](const Quantities& q) { return q.sky_patches != SkyPatchSet::none; },
     .ask =
         [](Quantities& q) {
           if (q.sky_patches == SkyPatchSet::none) q.sky_patches = SkyPatchSet::tregenza;
         },
     .describe = describe_patches,
     .add = &FurtherQuantities::add_patches},
    {.quantity = Quantity::sunlit,
     .word = {.word = "sunlit", .meaning = "hours of sunshine", .is_weighted = false},
     .is_asked = [](const Quantities& q) { return q.sun.has_value(); },
     .ask = ask_for_sun,
     .describe = describe_sunlit,
     .add = &FurtherQuantities::add_sunlit},
    {.quantity = Quantity::sunlit_total,
     .word = {.word = "sunlit_total", .meaning = "those past trees and through them", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::sunlit_total>,
     .ask =
         [](Quantities& q) {
           ask_for_sun(q);
           q.sunlit_total = true;
         },
     .describe = describe_sunlit_total,
     .add = &FurtherQuantities::add_sunlit_total},
    {.quantity = Quantity::shadow_patches,
     .word = {.word = "shadow_patches", .meaning = "what hides each of UMEP's 153, as bits", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::shadow_patches>,
     .ask = set_flag<&Quantities::shadow_patches>,
     .describe = describe_shadow_patches,
     .add = &FurtherQuantities::add_shadow_patches},
    {.quantity = Quantity::irradiation,
     .word = {.word = "irradiation", .meaning = "kWh/m² in a period"},
     .is_asked = is_flagged<&Quantities::irradiation>,
     .ask = set_flag<&Quantities::irradiation>,
     .describe = describe_irradiation,
     .add = &FurtherQuantities::add_irradiation},
    {.quantity = Quantity::irradiance,
     .word = {.word = "irradiance", .meaning = "its mean, W/m²"},
     .is_asked = is_flagged<&Quantities::irradiance>,
     .ask = set_flag<&Quantities::irradiance>,
     .describe = describe_irradiance,
     .add = &FurtherQuantities::add_irradiance},
    {.quantity = Quantity::illuminance,
     .word = {.word = "illuminance", .meaning = "lx, of weather that has it"},
     .is_asked = is_flagged<&Quantities::illuminance>,
     .ask = set_flag<&Quantities::illuminance>,
     .describe = describe_illuminance,
     .add = &FurtherQuantities::add_illuminance},
    {.quantity = Quantity::shade,
     .word = {.word = "shade", .meaning = "share of the hours of sun", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::shade>,
     .ask = set_flag<&Quantities::shade>,
     .describe = describe_shade,
     .add = &FurtherQuantities::add_shade},
    {.quantity = Quantity::sky_component,
     .word = {.word = "sky_component", .meaning = "light of an overcast sky"},
     .is_asked = is_flagged<&Quantities::sky_component>,
     .ask = set_flag<&Quantities::sky_component>,
     .describe = describe_sky_component,
     .add = &FurtherQuantities::add_sky_component},
    {.quantity = Quantity::view_factors,
     .word = {.word = "view_factors",
              .meaning = "what is seen: sky, ground, roofs, walls by azimuth, crowns",
              .is_weighted = false},
     .is_asked = is_flagged<&Quantities::view_factors>,
     .ask = set_flag<&Quantities::view_factors>,
     .describe = describe_views,
     .add = &FurtherQuantities::add_views},
    {.quantity = Quantity::view_factors_below,
     .word = {.word = "view_factors_below", .meaning = "what of it lies below the horizontal", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::view_factors_below>,
     .ask = set_flag<&Quantities::view_factors_below>,
     .describe = describe_views_below,
     .add = &FurtherQuantities::add_views_below},
    {.quantity = Quantity::view_cube,
     .word = {.word = "view_cube", .meaning = "the same of the six faces of a cube"},
     .is_asked = is_flagged<&Quantities::view_cube>,
     .ask = set_flag<&Quantities::view_cube>,
     .describe = describe_views_of_cube,
     .add = &FurtherQuantities::add_views_of_cube},
    {.quantity = Quantity::view_sphere,
     .word = {.word = "view_sphere", .meaning = "of all directions around", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::view_sphere>,
     .ask = set_flag<&Quantities::view_sphere>,
     .describe = describe_views_of_sphere,
     .add = &FurtherQuantities::add_views_of_sphere},
    {.quantity = Quantity::view_eye,
     .word = {.word = "view_eye", .meaning = "of a field at eye level: green view", .is_weighted = false},
     .is_asked = is_flagged<&Quantities::view_eye>,
     .ask = set_flag<&Quantities::view_eye>,
     .describe = describe_views_of_eye,
     .add = &FurtherQuantities::add_views_of_eye},
    {.quantity = Quantity::view_building,
     .word = {.word = "view_building",
              .meaning = "what a building fills of the view, and whether it is seen",
              .is_weighted = false},
     .is_asked = [](const Quantities& q) { return q.seen_building.has_value(); },
     .ask = [](Quantities& q) { q.seen_building = q.seen_building.value_or(""); },
     .describe = describe_view_of_building,
     .add = &FurtherQuantities::add_view_of_building},
    {.quantity = Quantity::svf_total,
     .word = {.word = "svf_total", .meaning = "and svfveg", .is_of_crowns = true},
     .is_asked = is_flagged<&Quantities::svf_total>,
     .ask = set_flag<&Quantities::svf_total>,
     .describe = describe_total,
     .add_of_crowns = add_total},
    {.quantity = Quantity::svfaveg,
     .word = {.word = "svfaveg", .meaning = "as UMEP has it", .is_of_crowns = true},
     .is_asked = is_flagged<&Quantities::svfaveg>,
     .ask = set_flag<&Quantities::svfaveg>,
     .describe = describe_svfaveg,
     .add_of_crowns = add_svfaveg},
    {.quantity = Quantity::directional_vegetation,
     .word = {.word = "directional_vegetation",
              .meaning = "both of each half of the sky, as UMEP has them",
              .is_of_crowns = true},
     .is_asked = is_flagged<&Quantities::directional_vegetation>,
     .ask = set_flag<&Quantities::directional_vegetation>,
     .describe = describe_directional_vegetation,
     .add_of_crowns = add_directional_vegetation},
    {.quantity = Quantity::shares,
     .word = {.word = "shares", .meaning = "of sky, vegetation and building", .is_of_crowns = true},
     .is_asked = is_flagged<&Quantities::sky_shares>,
     .ask = set_flag<&Quantities::sky_shares>,
     .describe = describe_shares,
     .add_of_crowns = add_shares},
});

/// The columns of the rows before one.
std::size_t columns_before(const QuantityRow* end, const Quantities& quantities) {
  Columns columns;
  for (const QuantityRow* row = table.data(); row != end; ++row)
    if (row->is_asked(quantities)) row->describe(quantities, columns);
  return columns.size();
}

}  // namespace

std::span<const QuantityRow> quantity_table() { return table; }

ColumnRange range_of(Quantity quantity, const Quantities& quantities) {
  const QuantityRow* const row = std::ranges::find(table, quantity, &QuantityRow::quantity);
  if (!row->is_asked(quantities)) return {};
  const std::size_t first = columns_before(row, quantities);
  return {first, columns_before(row + 1, quantities) - first};
}

ColumnRange range_of_crowns(const Quantities& quantities) {
  const QuantityRow* const row = std::ranges::find_if(table, [](const QuantityRow& r) { return r.word.is_of_crowns; });
  const std::size_t first = columns_before(row, quantities);
  return {first, columns_before(table.data() + table.size(), quantities) - first};
}

PatchBands patch_bands_of(SkyPatchSet set) {
  if (set == SkyPatchSet::none) return {};
  const std::size_t parts = set == SkyPatchSet::reinhart ? 2 : 1;
  PatchBands bands;
  for (const std::uint32_t count : {30U, 30U, 24U, 24U, 18U, 12U, 6U})
    for (std::size_t n = 0; n < parts; ++n) bands.counts.push_back(count * static_cast<std::uint32_t>(parts));
  bands.height = 1.0 / (static_cast<double>(bands.counts.size()) + 0.5);
  return bands;
}

TotalColumns total_columns_of(const Quantities& quantities) {
  const ColumnRange range = range_of(Quantity::svf_total, quantities);
  if (range.count == 0) return {};
  return {range.first, quantities.svf_total_bounds ? std::optional(range.first + 1) : std::nullopt};
}

std::vector<ColumnDescription> column_descriptions_of(const Quantities& quantities) {
  std::vector<ColumnDescription> columns;
  for (const QuantityRow& row : table)
    if (row.is_asked(quantities)) row.describe(quantities, columns);
  return columns;
}

std::vector<std::string> columns_of(const Quantities& quantities) {
  std::vector<std::string> names;
  for (ColumnDescription& column : column_descriptions_of(quantities)) names.push_back(std::move(column.name));
  return names;
}

bool ask_for(std::string_view word, Quantities& quantities) {
  const auto row = std::ranges::find_if(table, [&](const QuantityRow& r) { return r.word.word == word; });
  if (row != table.end()) row->ask(quantities);
  return row != table.end();
}

std::vector<QuantityWord> quantity_words() {
  std::vector<QuantityWord> words;
  for (const QuantityRow& row : table) words.push_back(row.word);
  return words;
}

std::vector<QuantityWord> words_of(const Quantities& quantities) {
  std::vector<QuantityWord> words;
  for (const QuantityRow& row : table)
    if (row.is_asked(quantities)) words.push_back(row.word);
  return words;
}

bool Quantities::any() const {
  return std::ranges::any_of(table, [this](const QuantityRow& row) { return row.is_asked(*this); });
}

bool Quantities::any_of_canopies() const {
  return std::ranges::any_of(table, [this](const QuantityRow& row) { return row.word.is_of_crowns && row.is_asked(*this); });
}

bool Quantities::any_weighted() const {
  return std::ranges::any_of(table, [this](const QuantityRow& row) { return row.word.is_weighted && row.is_asked(*this); });
}

}  // namespace farlod
