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

Json json_of(const RunSeconds& seconds, double total) {
  return {{"total", total},
          {"open", seconds.open},
          {"scenes", seconds.scenes},
          {"evaluate", seconds.evaluate},
          {"write", seconds.write}};
}

Json error_budget_json(const SvfRun& run, const SvfOptions& options) {
  return {{"allowed", *options.max_error},
          {"sampling_share", sampling_error_of(options.sky)},
          {"far_share", *options.sky.max_far_error},
          {"rays_traced_exactly", run.retraced_rays}};
}

Json json_of(const ErrorSummary& errors, std::size_t rays) {
  return {{"count", errors.count},
          {"rays", rays},
          {"mean_abs_error", errors.mean_abs_error},
          {"p99_abs_error", errors.p99_abs_error},
          {"max_abs_error", errors.max_abs_error},
          {"bias", errors.bias}};
}

}  // namespace

std::string svf_summary_json(const SvfRun& run, const SvfOptions& options, double total_seconds) {
  const double busy_s = run.seconds.scenes + run.seconds.evaluate;
  Json j = {
      {"receivers", run.receivers},
      {"nodata", run.inside_buildings + run.beyond_grid},
      {"engine", name_of(options.sky.engine)},
      {"seconds", json_of(run.seconds, total_seconds)},
      {"receivers_per_second", busy_s > 0.0 ? static_cast<double>(run.receivers) / busy_s : 0.0},
      {"rays", options.sky.rays},
      {"azimuths", options.sky.azimuths},
      {"receivers_by_rays", run.by_rays},
      {"peak_memory_mib", peak_memory_mib()},
      {"svf",
       {{"min", number_or_null(run.svf_min)}, {"mean", number_or_null(run.svf_mean)}, {"max", number_or_null(run.svf_max)}}}};
  if (options.max_error) j["max_error"] = error_budget_json(run, options);
  if (run.bounds) j["bounds"] = {{"mean_width", run.bounds->mean}, {"max_width", run.bounds->max}};
  if (run.errors) j["verify"] = json_of(*run.errors, std::max(verify_rays, options.sky.rays));
  return j.dump(1) + "\n";
}

}  // namespace farlod
