// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/result_provenance.hpp"

#include <fmt/core.h>

#include "farlod/version.hpp"

namespace farlod {
namespace {

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::horizon:
      return "horizon";
    case Engine::rays:
      return "rays";
    case Engine::exact:
      return "exact";
    case Engine::automatic:
    case Engine::near_only:  // which the program does not offer
      break;
  }
  return "auto";
}

const char* name_of(SurfaceChoice choice) {
  return choice == SurfaceChoice::roofs ? "roofs" : choice == SurfaceChoice::walls ? "walls" : "all";
}

std::string receivers_of(const SvfOptions& o) {
  if (o.source == ReceiverSource::surfaces)
    return fmt::format("--surfaces {} --spacing {}", name_of(o.surfaces.choice), o.surfaces.spacing_m);
  const std::string height =
      fmt::format("--height {}{}", o.placing.height_m, o.placing.above == HeightAbove::highest_surface ? " --on-surface" : "");
  return o.source == ReceiverSource::grid ? fmt::format("--grid {} {}", o.grid_step_m, height) : height;
}

std::string accuracy_options(const EvaluationSettings& e) {
  std::string text = fmt::format("--engine {} --sky {}", name_of(e.engine), e.weight == SkyWeight::cosine ? "cosine" : "solid");
  if (e.directions == DirectionSet::fibonacci) text += " --directions fibonacci";
  if (e.azimuths) text += fmt::format(" --azimuths {}", *e.azimuths);
  if (e.rays) text += fmt::format(" --rays {}", *e.rays);
  if (e.max_error) text += fmt::format(" --max-error {}", *e.max_error);
  if (e.bounds) text += " --bounds";
  return text;
}

/// The last part of a path that names a folder, with or without a slash behind it.
std::string name_of(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

Provenance provenance_of(const SvfOptions& options) {
  return {std::string("Far-LoD ") + software_version, name_of(options.package), xxh3_of_file(options.package / "manifest.json"),
          receivers_of(options) + " " + accuracy_options(options.evaluation)};
}

}  // namespace farlod
