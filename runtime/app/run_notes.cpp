// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/run_notes.hpp"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "console/progress.hpp"
#include "farlod/inspection.hpp"
#include "farlod/raster.hpp"

namespace farlod {
namespace {

/// What to tell of crowns that nothing which was asked for knows of.
std::optional<std::string> note_of_ignored_crowns(const Package& package, const SvfOptions& options) {
  const Quantities& further = options.evaluation.further;
  if (further.any_of_canopies() || further.any_dimmed_by_crowns() || further.any_seen_by_rays()) return std::nullopt;
  const std::uint64_t crowns = inventory_of(package).crowns.all();
  if (crowns == 0) return std::nullopt;
  // Nobody weighs svf_total by solid angle
  const bool is_solid = options.evaluation.weight == SkyWeight::solid_angle;
  return fmt::format("The city has {} crowns of trees, and what was asked for looks through them: --quantity {} counts them.",
                     with_commas(crowns), is_solid ? "view_factors, or without --sky solid svf_total," : "svf_total");
}

/// What to tell of light on pitched roofs: the pixels of a raster are level.
std::optional<std::string> note_of_level_receivers(const Package& package, const SvfOptions& options) {
  const bool is_on_roofs = options.source == ReceiverSource::grid && options.placing.above == HeightAbove::highest_surface;
  if (!is_on_roofs || !options.evaluation.further.any_of_light() || plan_of_surface_model(package)) return std::nullopt;
  return "Pixels are level, also on pitched roofs: what falls on the roofs themselves, --surfaces roofs tells.";
}

/// The root mean square of their noise is .00025.
constexpr std::size_t quiet_rays = 20'000;

/// What to tell of the engines that answer by a sample of rays, where it is so small that its noise is larger than the errors of
/// the engine auto.
std::optional<std::string> note_of_few_rays(const PackageDescription& city, const SvfOptions& options, std::size_t rays) {
  const EvaluationSettings& e = options.evaluation;
  const bool is_sample = e.engine == Engine::exact || (e.engine == Engine::rays && city.far_map_kind != "box");
  if (!is_sample || e.bounds || e.max_error || rays >= quiet_rays) return std::nullopt;
  // All engines trace the same directions on a box: two of them differ by less than either does from the truth
  const std::string_view than = city.far_map_kind == "box" ? "is not seen beside other engines, which trace the same directions"
                                                           : "is larger than the errors of the engine auto";
  return fmt::format("{} rays a receiver answered: their noise {} (--rays {} makes it small).", with_commas(rays), than,
                     quiet_rays);
}

/// What to tell of far maps that only rays can look up, which is not what the engines auto and horizon are asked for.
std::optional<std::string> note_of_box_maps(const PackageDescription& city, const SvfOptions& options, std::size_t rays) {
  const Engine engine = options.evaluation.engine;
  if (city.far_map_kind != "box" || engine == Engine::exact) return std::nullopt;
  const std::string advice = fmt::format(
      "their noise adds to the error of the map (--rays {} makes it small, farlod-pack --far-map horizon needs no rays)",
      quiet_rays);
  return fmt::format("The far maps are of the kind box, which have no horizons: {} rays a receiver answered{}{}.",
                     with_commas(rays), engine == Engine::horizon ? ", whatever the engine" : "",
                     rays < quiet_rays ? ", and " + advice : "");
}

}  // namespace

std::vector<std::string> notes_of_run(const Package& package, const SvfOptions& options, const EvaluationSummary& summary) {
  const std::size_t rays = summary.accuracy.rays;
  std::vector<std::string> notes;
  for (const std::optional<std::string>& note :
       std::array{note_of_ignored_crowns(package, options), note_of_level_receivers(package, options),
                  note_of_few_rays(package.description(), options, rays), note_of_box_maps(package.description(), options, rays)})
    if (note) notes.push_back(*note);
  return notes;
}

}  // namespace farlod
