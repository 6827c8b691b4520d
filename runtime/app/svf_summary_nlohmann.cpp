// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/svf_summary.hpp"
#include "console/peak_memory.hpp"
#include "evaluate/error_budget.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return "auto";
    case Engine::horizon:
      return "horizon";
    case Engine::exact:
      return "exact";
    case Engine::rays:
    case Engine::near_only:
      break;
  }
  return "rays";
}

}  // namespace

std::string svf_summary_json(const SvfRun& run, const SvfOptions& options, double total_seconds) {
  const double busy_s = run.seconds.scenes + run.seconds.evaluate;
  Json j = {
      {"receivers", run.receivers},
      {"nodata", run.inside_buildings + run.beyond_grid},
      {"engine", name_of(options.sky.engine)},
      {"seconds",
       {{"total", total_seconds},
        {"open", run.seconds.open},
        {"scenes", run.seconds.scenes},
        {"evaluate", run.seconds.evaluate},
        {"write", run.seconds.write}}},
      {"receivers_per_second", busy_s > 0.0 ? static_cast<double>(run.receivers) / busy_s : 0.0},
      {"rays", options.sky.rays},
      {"azimuths", options.sky.azimuths},
      {"receivers_by_rays", run.by_rays},
      {"peak_memory_mib", peak_memory_mib()},
      {"svf",
       {{"min", number_or_null(run.svf_min)}, {"mean", number_or_null(run.svf_mean)}, {"max", number_or_null(run.svf_max)}}}};
  if (options.max_error)
    j["max_error"] = {{"allowed", *options.max_error},
                      {"sampling_share", sampling_error_of(options.sky)},
                      {"far_share", *options.sky.max_far_error},
                      {"rays_traced_exactly", run.retraced_rays}};
  if (run.bounds) j["bounds"] = {{"mean_width", run.bounds->mean}, {"max_width", run.bounds->max}};
  if (run.errors)
    j["verify"] = {{"count", run.errors->count},
                   {"rays", std::max(verify_rays, options.sky.rays)},
                   {"mean_abs_error", run.errors->mean_abs_error},
                   {"p99_abs_error", run.errors->p99_abs_error},
                   {"max_abs_error", run.errors->max_abs_error},
                   {"bias", run.errors->bias}};
  return j.dump(1) + "\n";
}

}  // namespace farlod
