// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/quantity_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

#include "app/word_choice.hpp"
#include "base/nearest_word.hpp"
#include "console/option_list.hpp"
#include "console/wrong_usage.hpp"

namespace farlod {
namespace {

constexpr int first_year = 1960, last_year = 2200;  // of ERFA's leap seconds, and of what it promises of the Earth's orbit
constexpr std::size_t step_of_days = 5, step_of_years = 15;

/// The number that a part of a date is; none where there are other characters.
std::optional<unsigned> number_in(std::string_view text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// "2026-06-21", or "2026" for all of its days.
SunPeriod period_of(const std::string& text, std::size_t step_minutes) {
  const std::string_view all = text;
  const bool is_year = all.size() == 4, is_day = all.size() == 10 && all[4] == '-' && all[7] == '-';
  const auto year = number_in(all.substr(0, 4)), month = is_day ? number_in(all.substr(5, 2)) : 1U,
             day = is_day ? number_in(all.substr(8, 2)) : 1U;
  if ((!is_year && !is_day) || !year || !month || !day)
    throw CLI::ValidationError("--sun", "\"" + text + "\" is neither a day, like 2026-06-21, nor a year, like 2026");
  const std::chrono::year_month_day first{std::chrono::year(static_cast<int>(*year)), std::chrono::month(*month),
                                          std::chrono::day(*day)};
  if (!first.ok() || static_cast<int>(*year) < first_year || static_cast<int>(*year) > last_year)
    throw CLI::ValidationError(
        "--sun", "\"" + text + "\" is no day from " + std::to_string(first_year) + " to " + std::to_string(last_year));
  const std::size_t days = is_day ? 1 : first.year().is_leap() ? 366 : 365;
  const std::size_t minutes = step_minutes > 0 ? step_minutes : is_day ? step_of_days : step_of_years;
  return {std::chrono::sys_days(first), days, std::chrono::minutes(static_cast<std::int64_t>(minutes))};
}

/// "svf_solid (share of the solid angle), directional ...".
std::string words_with_meanings(bool of_crowns) {
  std::string words;
  for (const QuantityWord& q : quantity_words())
    if (q.is_of_crowns == of_crowns)
      words.append(words.empty() ? "" : ", ").append(q.word).append(" (").append(q.meaning).append(")");
  return words;
}

bool is_of_crowns(const QuantityWord& q) { return q.is_of_crowns; }
bool is_not_weighted(const QuantityWord& q) { return !q.is_weighted; }

/// "horizon, horizon_distance and sunlit": the words with a property, and what stands before the last.
std::string words_that(bool (*have_it)(const QuantityWord&), const char* before_last) {
  std::vector<std::string_view> words;
  for (const QuantityWord& q : quantity_words())
    if (have_it(q)) words.push_back(q.word);
  return fmt::format("{}{}{}", fmt::join(words.begin(), words.end() - 1, ", "), before_last, words.back());
}

bool is_quantity(const std::string& word) {
  Quantities alone;
  return ask_for(word, alone);
}

/// The quantity that has a column or band of this name; none: empty.
std::string_view quantity_of_band(const std::string& band) {
  for (const QuantityWord& q : quantity_words()) {
    Quantities alone;
    alone.wall_sectors = 8;  // the names of 4 are among them
    alone.svf_total_bounds = true;
    (void)ask_for(q.word, alone);
    const std::vector<std::string> bands = columns_of(alone);
    if (std::ranges::find(bands, band) != bands.end()) return q.word;
  }
  return {};
}

void add(const std::string& word, const RawQuantities& raw, Quantities& quantities) {
  if (word == "svf") return;
  // Where the sun stands depends on the package
  if (word.starts_with("sunlit") && raw.sun.empty() && is_quantity(word))
    throw CLI::ValidationError("--quantity", word + " needs a day or a year: give --sun");
  if (word == "sunlit") return;
  if (ask_for(word, quantities)) return;
  if (word.empty()) throw CLI::ValidationError("--quantity", "\"" + raw.quantities + "\" has an empty name: leave a comma out");
  if (const std::string_view quantity = quantity_of_band(word); !quantity.empty())
    throw CLI::ValidationError("--quantity", fmt::format("\"{}\" is a band of --quantity {}", word, quantity));
  std::vector<std::string> words{"svf"};
  for (const QuantityWord& known : quantity_words()) words.emplace_back(known.word);
  throw CLI::ValidationError("--quantity",
                             fmt::format("\"{}\" is not one of {}{}", word, fmt::join(words, ", "), did_you_mean(word, words)));
}

void add_canopy_options(CLI::App& app, RawQuantities& raw) {
  app.add_option(
         "--canopy-rule", raw.canopy_rule,
         "How light passes crowns: umep: a share in each direction that meets any; crowns: that share of each one that is "
         "met, multiplied; beer: by the length within them (--extinction)")
      ->check(one_of(canopy_rule_words))
      ->capture_default_str()
      ->group("Trees");
  app.add_option("--transmissivity", raw.transmissivity,
                 "Share of light that passes a crown (default: 0.03, and with --leaf-off 0.5)")
      ->check(between(0.0, 1.0))
      ->group("Trees");
  app.add_option("--extinction", raw.extinction_per_m,
                 "With --canopy-rule beer: of crowns in leaf, per metre (default: 0.6); a fifth of it with --leaf-off")
      ->check(between(0.001, 100.0))
      ->group("Trees");
  app.add_flag("--leaf-off", raw.leaf_off, "Winter: all crowns are bare but those that are known to be evergreen")
      ->group("Trees");
}

CanopySettings canopy_of(const RawQuantities& raw, bool knows_trees) {
  CanopySettings canopy;
  canopy.rule = value_of(canopy_rule_words, raw.canopy_rule).value_or(CanopyRule::once);
  const bool is_beer = canopy.rule == CanopyRule::beer;
  canopy.season = raw.leaf_off ? Season::leaf_off : Season::leaf_on;
  canopy.transmissivity = raw.transmissivity;
  if (raw.extinction_per_m) canopy.extinction_per_m = *raw.extinction_per_m;
  if (raw.transmissivity && is_beer)
    throw CLI::ValidationError("--transmissivity", "--canopy-rule beer counts lengths within crowns: give --extinction");
  if (raw.extinction_per_m && !is_beer) throw CLI::ValidationError("--extinction", "it goes with --canopy-rule beer");
  if (!(canopy == CanopySettings{}) && !knows_trees)
    throw CLI::ValidationError(raw.leaf_off         ? "--leaf-off"
                               : raw.transmissivity ? "--transmissivity"
                                                    : "--canopy-rule",
                               "this run computes nothing of trees: add --quantity " + words_that(is_of_crowns, " or "));
  return canopy;
}

void add_sun_options(CLI::App& app, RawQuantities& raw) {
  app.add_option(
         "--sun", raw.sun,
         "Hours of sunshine, were the sky clear, of a day, as 2026-06-21, or a year, as 2026, from midnight to midnight of "
         "local mean time; where there are trees, past them and through them, too. A picture of the sky above --at shows the "
         "sun's path")
      ->group("Quantities");
  app.add_option("--sun-step", raw.sun_step_minutes,
                 "Minutes from one position of the sun to the next (default: " + std::to_string(step_of_days) + " for a day, " +
                     std::to_string(step_of_years) + " for a year)")
      ->check(between(1, 60))
      ->group("Quantities");
}

void add_view_options(CLI::App& app, RawQuantities& raw) {
  app.add_option("--sees", raw.sees,
                 "With view_building: the building that receivers look for, by its id, as the tables of --surfaces name it")
      ->group("Quantities");
  app.add_option("--wall-sectors", raw.wall_sectors,
                 "With view_factors and its like: tell walls by 4 parts of the turn (default) or 8: north, north-east, ...")
      ->check(one_of_words({"4", "8"}))
      ->group("Quantities");
  app.add_option("--eye-field", raw.eye_field_deg,
                 "With view_eye: what is seen within so many degrees above and below the horizontal (default: 30); 90 is all "
                 "around")
      ->check(between(1.0, 90.0))
      ->group("Quantities");
}

/// Sets what goes with the quantities that say what fills the view.
void resolve_views(const RawQuantities& raw, Quantities& quantities) {
  if (raw.wall_sectors > 0) quantities.wall_sectors = raw.wall_sectors;
  if (raw.eye_field_deg) quantities.eye_field_deg = *raw.eye_field_deg;
  if (quantities.seen_building && raw.sees.empty())
    throw CLI::ValidationError("--quantity", "view_building needs a building to look for: give its id with --sees");
  if (!raw.sees.empty() && !quantities.seen_building)
    throw CLI::ValidationError("--sees", "it goes with --quantity view_building");
  if (quantities.seen_building) quantities.seen_building = raw.sees;
  if (raw.wall_sectors > 0 && !quantities.any_of_views())
    throw CLI::ValidationError("--wall-sectors", "it goes with view_factors, view_cube, view_sphere or view_eye (--quantity)");
  if (raw.eye_field_deg && !quantities.view_eye) throw CLI::ValidationError("--eye-field", "it goes with --quantity view_eye");
}

}  // namespace

std::string words_of_unweighted() { return words_that(is_not_weighted, " and "); }

void add_quantity_options(CLI::App& app, RawQuantities& raw) {
  app.add_option("--quantity", raw.quantities,
                 "What to compute, with commas: svf (always; by default with svf_total where there are trees), " +
                     words_with_meanings(false) + "; with the trees of a package " + words_with_meanings(true))
      ->group("Quantities");
  app.add_option("--horizons", raw.horizons,
                 "Elevations of the horizon, in degrees, at so many azimuths, clockwise from true north")
      ->check(between(4, 3600))
      ->group("Quantities");
  app.add_option("--sky-patches", raw.sky_patches,
                 "The share seen of each patch of the sky, as Radiance counts them: 145 (Tregenza) or 577 (Reinhart)")
      ->check(one_of_words({std::to_string(tregenza_patches), std::to_string(reinhart_patches)}))
      ->group("Quantities");
  add_view_options(app, raw);
  add_sun_options(app, raw);
  add_canopy_options(app, raw);
}

void add_for_solweig(const OutputFormat& format, bool has_trees, Quantities& quantities) {
  if (!format.is_for_solweig) return;
  quantities.directional = true;
  quantities.shadow_patches = quantities.shadow_patches || format.is_solweig_kit;
  if (has_trees) quantities.svf_total = quantities.svfaveg = quantities.directional_vegetation = true;
}

RequestedQuantities resolved(const RawQuantities& raw, const OutputFormat* format) {
  RequestedQuantities requested;
  if (format != nullptr) add_for_solweig(*format, /*has_trees=*/false, requested.further);
  if (!raw.quantities.empty())
    for (const std::string& name : CLI::detail::split(raw.quantities + ',', ',')) add(name, raw, requested.further);
  if (raw.horizons > 0) requested.further.horizons = raw.horizons;
  if (raw.sky_patches > 0)
    requested.further.sky_patches = raw.sky_patches == reinhart_patches ? SkyPatchSet::reinhart : SkyPatchSet::tregenza;
  resolve_views(raw, requested.further);
  if (!raw.sun.empty()) requested.sunshine = period_of(raw.sun, raw.sun_step_minutes);
  requested.further.canopy = canopy_of(raw, (format != nullptr && format->is_for_solweig) || requested.sunshine ||
                                                requested.further.any_of_canopies() || requested.further.any_dimmed_by_crowns());
  if (raw.sun.empty() && raw.sun_step_minutes > 0) throw CLI::ValidationError("--sun-step", "it goes with --sun");
  return requested;
}

}  // namespace farlod
