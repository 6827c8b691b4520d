// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/result_provenance.hpp"

#include <fmt/core.h>

#include "farlod/version.hpp"

namespace farlod {
namespace {

const char* name_of(SurfaceChoice choice) {
  return choice == SurfaceChoice::roofs ? "roofs" : choice == SurfaceChoice::walls ? "walls" : "all";
}

std::string receivers_of(const SvfOptions& o) {
  const double spacing_m = o.surfaces.spacing_m;
  if (o.source == ReceiverSource::surfaces)
    return fmt::format("--surfaces {} --spacing {}", name_of(o.surfaces.choice), spacing_m);
  const std::string height =
      fmt::format("--height {}{}", o.placing.height_m, o.placing.above == HeightAbove::highest_surface ? " --on-surface" : "");
  if (o.source == ReceiverSource::lines)
    return fmt::format("--along {} --spacing {} {}", o.points_file.filename().string(), spacing_m, height);
  if (!o.grid_like.empty()) return fmt::format("--grid-like {} {}", o.grid_like.filename().string(), height);
  return o.source == ReceiverSource::grid ? fmt::format("--grid {} {}", o.grid_step_m, height) : height;
}

std::string accuracy_options(const EvaluationSettings& e) {
  std::string text = fmt::format("--engine {} --sky {}", word_for(e.engine), e.weight == SkyWeight::cosine ? "cosine" : "solid");
  if (e.directions == DirectionSet::fibonacci) text += " --directions fibonacci";
  if (e.azimuths) text += fmt::format(" --azimuths {}", *e.azimuths);
  if (e.rays) text += fmt::format(" --rays {}", *e.rays);
  if (e.max_error) text += fmt::format(" --max-error {}", *e.max_error);
  if (e.bounds) text += " --bounds";
  return text;
}

std::string canopy_options(const CanopySettings& canopy) {
  std::string text = fmt::format(" --canopy-rule {}", word_for(canopy.rule));
  if (canopy.rule == CanopyRule::beer)
    text += fmt::format(" --extinction {}", canopy.extinction_per_m);
  else if (canopy.transmissivity)
    text += fmt::format(" --transmissivity {}", *canopy.transmissivity);
  return text + (canopy.season == Season::leaf_off ? " --leaf-off" : "");
}

std::string quantity_options(const SvfOptions& o) {
  const Quantities& q = o.evaluation.further;
  std::string text;
  if (q.svf_solid) text += ",svf_solid";
  if (q.directional) text += ",directional";
  if (q.hidden) text += ",hidden";
  if (q.horizon_distances) text += ",horizon_distance";
  if (q.svf_total) text += ",svf_total";
  if (q.svfaveg) text += ",svfaveg";
  if (q.directional_vegetation) text += ",directional_vegetation";
  if (q.sky_shares) text += ",shares";
  if (!text.empty()) text = " --quantity svf" + text;
  if (q.horizons > 0) text += fmt::format(" --horizons {}", q.horizons);
  if (q.sky_patches != SkyPatchSet::none)
    text += fmt::format(" --sky-patches {}", q.sky_patches == SkyPatchSet::reinhart ? reinhart_patches : tregenza_patches);
  if (o.sunshine) {
    const std::chrono::year_month_day first(o.sunshine->first);
    text += fmt::format(" --sun {:04}", static_cast<int>(first.year()));
    if (o.sunshine->days == 1)
      text += fmt::format("-{:02}-{:02}", static_cast<unsigned>(first.month()), static_cast<unsigned>(first.day()));
    text += fmt::format(" --sun-step {}", o.sunshine->step.count());
  }
  return text + (q.any_of_canopies() ? canopy_options(q.canopy) : "");
}

std::string part_of_package(const SvfOptions& o) {
  std::string text;
  if (const auto& box = o.bbox_projected; box && o.source != ReceiverSource::grid)
    text += fmt::format(" --bbox {},{},{},{}", box->low.x, box->low.y, box->high.x, box->high.y);
  if (!o.mask_file.empty()) text += " --mask " + o.mask_file.filename().string();
  return text;
}

/// The last part of a path that names a folder, with or without a slash behind it.
std::string name_of(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

Provenance provenance_of(const SvfOptions& options, const PackageDescription& package) {
  return {
      std::string("Far-LoD ") + software_version, name_of(options.package), fmt::format("{:016x}", package.manifest_xxh3),
      receivers_of(options) + " " + accuracy_options(options.evaluation) + quantity_options(options) + part_of_package(options)};
}

}  // namespace farlod
