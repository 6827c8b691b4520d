// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/picture_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <set>

#include "app/format_advice.hpp"
#include "console/option_list.hpp"
#include "console/wrong_usage.hpp"

namespace farlod {
namespace {

const OutputFormat* picture_format_of(const std::string& file, const char* option) {
  const auto is_picture = [](const OutputFormat& f) { return f.is_picture; };
  const OutputFormat* const format = output_format_of(file);
  if (format == nullptr || !is_picture(*format))
    throw CLI::ValidationError(option, "\"" + file + "\" is not the name of a picture: " + advice(is_picture));
  return format;
}

void resolve_preview(SvfOptions& o) {
  if (o.preview_file.empty()) return;
  if (o.source != ReceiverSource::grid) throw CLI::ValidationError("--preview", "it goes with --grid");
  o.preview_format = picture_format_of(o.preview_file, "--preview");
}

void resolve_histogram(const SvfOptions& o) {
  if (o.histogram_file.empty()) return;
  if (o.source == ReceiverSource::at)
    throw CLI::ValidationError("--histogram", "it goes with --grid, --points, --along and --surfaces");
  (void)picture_format_of(o.histogram_file, "--histogram");
}

void resolve_verify_map(SvfOptions& o) {
  if (o.verify_file.empty()) return;
  if (o.evaluation.verify == 0) throw CLI::ValidationError("--verify-map", "it needs receivers to verify: give --verify");
  if (o.source == ReceiverSource::at)
    throw CLI::ValidationError("--verify-map", "it goes with --grid, --points, --along and --surfaces");
  o.verify_format = output_format_of(o.verify_file);
  const auto fits = [](const OutputFormat& f) { return f.is_picture || f.name == "CSV"; };
  if (o.verify_format == nullptr || !fits(*o.verify_format))
    throw CLI::ValidationError("--verify-map", "\"" + o.verify_file + "\" is neither a picture nor a table: " + advice(fits));
}

void resolve_projection(const RawPictures& raw, SvfOptions& o) {
  if (raw.projection.empty()) return;
  if (o.source != ReceiverSource::at || !o.format->is_picture)
    throw CLI::ValidationError("--projection", "it goes with a picture of --at");
  o.projection = raw.projection == "equidistant"  ? SkyProjection::equidistant
                 : raw.projection == "equal-area" ? SkyProjection::equal_area
                                                  : SkyProjection::orthographic;
}

/// The words of --quantity.
std::vector<std::string> quantity_words_in(const RawQuantities& raw) {
  return raw.quantities.empty() ? std::vector<std::string>{} : CLI::detail::split(raw.quantities, ',');
}

/// The name of the first column of a quantity.
std::string first_column_of(const std::string& quantity) {
  if (quantity.starts_with("sunlit")) return quantity + "_h";
  Quantities alone;
  const bool is_known = ask_for(quantity, alone);
  const std::vector<std::string> columns = is_known ? columns_of(alone) : std::vector<std::string>{};
  return columns.empty() ? quantity : columns.front();
}

std::string text_of_days(const SunPeriod& sun) {
  const std::chrono::year_month_day first(sun.first);
  const int year = static_cast<int>(first.year());
  if (sun.days > 1) return fmt::format("{}", year);
  return fmt::format("{}-{:02}-{:02}", year, static_cast<unsigned>(first.month()), static_cast<unsigned>(first.day()));
}

std::string text_of_light(const LightSource& light) {
  const std::string period = light.period.empty() ? "All of the weather" : light.period;
  return light.weather_file.empty() ? period + ", clear sky" : period;
}

std::string text_of_height(const Placing& placing) {
  constexpr double lowest_m = 0.1;  // what stands lower is said to stand on the surface
  const char* const zero = placing.above == HeightAbove::ground            ? "the ground"
                           : placing.above == HeightAbove::highest_surface ? "the surface"
                                                                           : "sea level";
  if (placing.above == HeightAbove::highest_surface && placing.height_m < lowest_m) return "on the surface";
  return fmt::format("{:g} m above {}", placing.height_m, zero);
}

/// The same with a capital, which digits have none of.
std::string as_sentence(std::string text) {
  if ('a' <= text.front() && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

}  // namespace

std::string conditions_of(const SvfOptions& options, const std::string& column) {
  const auto is_one_of = [&](const auto& names) {
    return std::ranges::any_of(names, [&](const char* name) { return column.starts_with(name); });
  };
  constexpr std::array<const char*, 4> of_light{"irradiation", "irradiance", "illuminance", "shade"};
  const std::string height = text_of_height(options.placing);
  if (options.light && is_one_of(of_light)) return text_of_light(*options.light) + ", " + height;
  if (options.sunshine && column.starts_with("sunlit")) return text_of_days(*options.sunshine) + ", " + height;
  return as_sentence(height);
}

bool fits_picture(const RawQuantities& raw) {
  std::set<std::string> besides;
  for (const std::string& word : quantity_words_in(raw))
    if (word != "svf") besides.insert(word);
  if (!raw.sun.empty() && !besides.contains("sunlit_total")) besides.insert("sunlit");
  if (raw.horizons > 0 && !besides.contains("horizon_distance")) besides.insert("horizon");
  if (raw.sky_patches > 0) besides.insert("sky_patches");
  return besides.size() <= 1;
}

std::string drawn_quantity(const RawQuantities& raw) {
  const std::vector<std::string> words = quantity_words_in(raw);
  if (!words.empty()) return words.back();
  return !raw.sun.empty() ? "" : raw.horizons > 0 ? "horizon" : raw.sky_patches > 0 ? "sky_patches" : "";
}

std::size_t drawn_band_of(const SvfOptions& options, const std::vector<ColumnDescription>& bands) {
  // What --sun asks for, and else what a city with trees has by itself: with them first
  std::vector<std::string> names{"sunlit_total_h", "sunlit_h", "svf_total"};
  if (!options.drawn_quantity.empty()) names = {first_column_of(options.drawn_quantity)};
  for (const std::string& name : names) {
    // Names of horizons may have decimals
    const auto found = std::ranges::find_if(bands, [&](const ColumnDescription& band) { return band.name.starts_with(name); });
    if (found != bands.end()) return static_cast<std::size_t>(found - bands.begin());
  }
  return 0;
}

void add_picture_options(CLI::App& app, RawPictures& raw, SvfOptions& o) {
  app.add_option(
         "--preview", o.preview_file,
         "Also draw the raster as this picture (PNG, SVG or PDF), with a colour scale: the quantity that is named last, else "
         "hours of --sun, svf_total where it comes by itself, or svf")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--histogram", o.histogram_file,
                 "Also draw how the values of the quantity that --preview shows are distributed, as this picture (PNG, SVG or "
                 "PDF); surfaces count by their area")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--projection", raw.projection, "Of a picture of the sky above --at (default: equal-area)")
      ->check(one_of_words({"equidistant", "equal-area", "orthographic"}))
      ->group("Output");
}

void resolve_pictures(const RawPictures& raw, SvfOptions& o) {
  resolve_preview(o);
  resolve_verify_map(o);
  resolve_histogram(o);
  resolve_projection(raw, o);
}

}  // namespace farlod
