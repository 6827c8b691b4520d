// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/result_key.hpp"

#include <fmt/core.h>

#include "farlod/version.hpp"

namespace farlod {
namespace {

constexpr const char* flag = "on";

std::string name_of_file(const std::filesystem::path& file) { return file.filename().string(); }

std::string text_of(const Box2d& box) { return fmt::format("{},{},{},{}", box.low.x, box.low.y, box.high.x, box.high.y); }

void add_height(const Placing& placing, AnswerKey& key) {
  key.emplace_back("--height", fmt::format("{}", placing.height_m));
  if (placing.above == HeightAbove::highest_surface) key.emplace_back("--on-surface", flag);
}

void add_receivers(const SvfOptions& o, AnswerKey& key) {
  const auto spacing = [&] { key.emplace_back("--spacing", fmt::format("{}", o.surfaces.spacing_m)); };
  switch (o.source) {
    case ReceiverSource::surfaces:
      key.emplace_back("--surfaces", word_for(surface_choice_words, o.surfaces.choice));
      return spacing();
    case ReceiverSource::lines:
      key.emplace_back("--along", name_of_file(o.points_file));
      spacing();
      break;
    case ReceiverSource::grid:
      if (o.grid_like.empty() && !o.own_pixels) key.emplace_back("--grid", fmt::format("{}", o.grid_step_m));
      break;
    case ReceiverSource::points:
    case ReceiverSource::at:
      break;
  }
  if (!o.grid_like.empty()) key.emplace_back("--grid-like", name_of_file(o.grid_like));
  add_height(o.placing, key);
}

void add_accuracy(const EvaluationSettings& e, AnswerKey& key) {
  key.emplace_back("--engine", word_for(engine_words, e.engine));
  key.emplace_back("--sky", word_for(sky_weight_words, e.weight));
  if (e.directions == DirectionSet::fibonacci) key.emplace_back("--directions", word_for(direction_set_words, e.directions));
  if (e.azimuths) key.emplace_back("--azimuths", fmt::format("{}", *e.azimuths));
  if (e.rays) key.emplace_back("--rays", fmt::format("{}", *e.rays));
  if (e.max_error) key.emplace_back("--max-error", fmt::format("{}", *e.max_error));
  if (e.bounds) key.emplace_back("--bounds", flag);
}

void add_sun(const SunPeriod& sun, AnswerKey& key) {
  const std::chrono::year_month_day first(sun.first);
  std::string days = fmt::format("{:04}", static_cast<int>(first.year()));
  if (sun.days == 1)
    days += fmt::format("-{:02}-{:02}", static_cast<unsigned>(first.month()), static_cast<unsigned>(first.day()));
  key.emplace_back("--sun", days);
  key.emplace_back("--sun-step", fmt::format("{}", sun.step.count()));
}

void add_light(const LightSource& source, const Light& light, AnswerKey& key) {
  if (source.weather_file.empty())
    key.emplace_back("--linke", fmt::format("{}", source.linke_turbidity));
  else
    key.emplace_back("--weather", name_of_file(source.weather_file));
  if (!source.period.empty()) key.emplace_back("--period", source.period);
  key.emplace_back("--step", fmt::format("{}", source.step.count()));
  key.emplace_back("--sky-model", word_for(sky_model_words, light.sky_model));
  key.emplace_back("--albedo", fmt::format("{},{}", light.ground_albedo, light.facade_albedo));
  if (light.by_month || light.by_step) key.emplace_back("--by", light.by_month ? "month" : "step");
}

void add_canopy(const CanopySettings& canopy, AnswerKey& key) {
  key.emplace_back("--canopy-rule", word_for(canopy_rule_words, canopy.rule));
  if (canopy.rule == CanopyRule::beer)
    key.emplace_back("--extinction", fmt::format("{}", canopy.extinction_per_m));
  else if (canopy.transmissivity)
    key.emplace_back("--transmissivity", fmt::format("{}", *canopy.transmissivity));
  if (canopy.season == Season::leaf_off) key.emplace_back("--leaf-off", flag);
}

void add_quantities(const Quantities& q, AnswerKey& key) {
  std::string further;
  for (const QuantityWord& asked : words_of(q))
    // Numbers of horizons and patches have options of their own, as the days of the sun
    if (asked.word != "horizon" && asked.word != "sky_patches" && asked.word != "sunlit") further.append(",").append(asked.word);
  if (!further.empty()) key.emplace_back("--quantity", "svf" + further);
  if (q.horizons > 0) key.emplace_back("--horizons", fmt::format("{}", q.horizons));
  if (q.sky_patches != SkyPatchSet::none)
    key.emplace_back("--sky-patches",
                     fmt::format("{}", q.sky_patches == SkyPatchSet::reinhart ? reinhart_patches : tregenza_patches));
  if (q.any_of_views() && q.wall_sectors != Quantities().wall_sectors)
    key.emplace_back("--wall-sectors", fmt::format("{}", q.wall_sectors));
  if (q.seen_building) key.emplace_back("--sees", *q.seen_building);
  if (q.view_eye) key.emplace_back("--eye-field", fmt::format("{:g}", q.eye_field_deg));
}

/// The last part of a path that names a folder, with or without a slash behind it.
std::string name_of_folder(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

AnswerKey key_of(const SvfOptions& o) {
  AnswerKey key;
  add_receivers(o, key);
  add_accuracy(o.evaluation, key);
  add_quantities(o.evaluation.further, key);
  if (o.sunshine) add_sun(*o.sunshine, key);
  if (o.light) add_light(*o.light, o.evaluation.further.light.value_or(Light{}), key);
  if (o.evaluation.further.any_of_canopies() || o.evaluation.further.any_dimmed_by_crowns())
    add_canopy(o.evaluation.further.canopy, key);
  // The frame of a raster tells its box
  if (o.bbox_projected && o.source != ReceiverSource::grid) key.emplace_back("--bbox", text_of(*o.bbox_projected));
  if (!o.mask_file.empty()) key.emplace_back("--mask", name_of_file(o.mask_file));
  if (o.evaluation.within_m) key.emplace_back("--within", fmt::format("{:g}", *o.evaluation.within_m));
  return key;
}

AnswerKey key_of_answers(const SvfOptions& o, const PackageDescription& package) {
  const Provenance provenance = provenance_of(o, package);
  AnswerKey key{{"the program", provenance.software}, {"the checksum of the package", provenance.manifest_xxh3}};
  for (const auto& option : key_of(o)) key.push_back(option);
  if (o.bbox_projected) key.emplace_back("the box", text_of(*o.bbox_projected));
  if (!o.points_crs.empty()) key.emplace_back("--points-crs", o.points_crs);
  if (!o.points_layer.empty()) key.emplace_back("--points-layer", o.points_layer);
  const std::filesystem::path weather = o.light ? o.light->weather_file : std::filesystem::path();
  for (const std::filesystem::path& file : {o.points_file, o.mask_file, o.grid_like, weather})
    if (!file.empty()) key.emplace_back("the checksum of " + name_of_file(file), xxh3_of_file(file));
  return key;
}

Provenance provenance_of(const SvfOptions& options, const PackageDescription& package) {
  std::string settings;
  for (const auto& [option, value] : key_of(options))
    settings += (settings.empty() ? "" : " ") + option + (value == flag ? "" : " " + value);
  // It changes no answer, but what tables say of them
  if (const auto& threshold = options.surfaces.irradiation_threshold_kwh_m2)
    settings += fmt::format(" --irradiation-threshold {}", *threshold);
  return {std::string("Far-LoD ") + software_version, name_of_folder(options.package),
          fmt::format("{:016x}", package.manifest_xxh3), settings};
}

}  // namespace farlod
