// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "app/svf_summary.hpp"
#include "console/run_program.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json seconds_json(const WrittenRun& written, double total) {
  const EvaluationSeconds& seconds = written.summary.seconds;
  return {{"total", total},
          {"open", written.open_s},
          {"scenes", seconds.scenes},
          {"evaluate", seconds.evaluate},
          {"write", seconds.deliver + written.write_s}};
}

Json error_budget_json(const EvaluationSummary& run, double allowed) {
  return {{"allowed", allowed},
          {"sampling_share", run.accuracy.sampling_error},
          {"far_share", *run.accuracy.far_error_allowed},
          {"rays_traced_exactly", run.retraced_rays}};
}

Json json_of(const RunEstimate& estimate, double output_bytes) {
  constexpr double mib = 1 << 20;
  return {{"cells", estimate.cells},
          {"evaluated_cells", estimate.evaluated_cells},
          {"evaluated_receivers", estimate.evaluated_receivers},
          {"receivers", estimate.receivers},
          {"seconds", estimate.seconds},
          {"memory_mib", estimate.memory_bytes / mib},
          {"output_mib", output_bytes / mib}};
}

Json json_of(const BoundsWidth& width) { return {{"mean_width", width.mean}, {"max_width", width.max}}; }

Json json_of(const ErrorSummary& errors) {
  return {{"count", errors.count},
          {"rays", errors.rays},
          {"mean_abs_error", errors.mean_abs_error},
          {"p99_abs_error", errors.p99_abs_error},
          {"max_abs_error", errors.max_abs_error},
          {"bias", errors.bias}};
}

/// The light of a run, and what reflects it.
Json json_of(const PeriodLight& light, const Light& asked, const LightSource& source) {
  return {{"source", light.source},
          {"hours", light.hours},
          {"period", source.period.empty() ? Json(nullptr) : Json(source.period)},
          {"step_minutes", source.step.count()},
          {"sky_model", word_for(sky_model_words, asked.sky_model)},
          {"ground_albedo", asked.ground_albedo},
          {"facade_albedo", asked.facade_albedo},
          {"global_horizontal_kwh_m2", light.global_horizontal_kwh_m2},
          {"remarks", light.remarks}};
}

Json json_of(const WrittenMatrix& matrix) {
  const MatrixFigures& figures = matrix.figures;
  return {{"surfaces", matrix.surfaces},
          {"columns", matrix.columns},
          {"entries", matrix.entries},
          {"receivers", figures.receivers},
          {"rays", figures.rays},
          {"threshold", matrix.threshold},
          {"reciprocity", {{"mean", figures.reciprocity_mean}, {"max", figures.reciprocity_max}}},
          {"closure", {{"mean", figures.closure_mean}, {"max", figures.closure_max}}},
          {"dropped", {{"mean", figures.dropped_mean}, {"max", figures.dropped_max}}},
          {"divided_rows", figures.divided_rows},
          {"seconds", matrix.seconds}};
}

void add_accuracy_and_totals(const EvaluationSummary& run, Json& j) {
  if (run.bounds) j["bounds"] = json_of(*run.bounds);
  if (run.errors) j["verify"] = json_of(*run.errors);
  if (run.svf_total) j["svf_total"] = {{"min", run.svf_total->min}, {"mean", run.svf_total->mean}, {"max", run.svf_total->max}};
  if (run.svf_total_bounds) j["svf_total_bounds"] = json_of(*run.svf_total_bounds);
  if (run.svf_total_errors) j["svf_total_verify"] = json_of(*run.svf_total_errors);
}

Json values_json(const EvaluationSummary& run) {
  return {{"min", number_or_null(run.svf_min)},
          {"mean", number_or_null(run.svf_mean)},
          {"median", number_or_null(run.svf_median)},
          {"max", number_or_null(run.svf_max)},
          {"mean_near_buildings", number_or_null(run.svf_mean_near_buildings)}};
}

void add_further(const WrittenRun& written, Json& j) {
  if (written.matrix) j["matrix"] = json_of(*written.matrix);
  for (const ColumnDescription& column : written.further_columns) j["quantities"].push_back(column.name);
  const auto& ranges = written.summary.further;
  for (std::size_t k = 0; k < ranges.size(); ++k)
    if (const auto& range = ranges[k])
      j["values"][written.further_columns[k].name] = {{"min", range->min}, {"mean", range->mean}, {"max", range->max}};
}

}  // namespace

std::string svf_summary_json(const WrittenRun& written, const SvfOptions& options, double total_seconds) {
  const EvaluationSummary& run = written.summary;
  const double busy_s = run.seconds.scenes + run.seconds.evaluate;
  Json j = {{"receivers", run.receivers},
            {"nodata", run.no_data + run.beyond_grid},
            {"engine", word_for(engine_words, options.evaluation.engine)},
            {"seconds", seconds_json(written, total_seconds)},
            {"receivers_per_second", busy_s > 0.0 ? static_cast<double>(run.receivers) / busy_s : 0.0},
            {"rays", run.accuracy.rays},
            {"azimuths", run.accuracy.azimuths},
            {"receivers_by_rays", run.by_rays},
            {"receivers_without_far_map", run.without_far_map},
            {"receivers_outside_of_grid", run.outside_of_grid},
            {"receivers_near_buildings", run.near_buildings},
            {"peak_memory_mib", peak_memory_mib()},
            {"svf", values_json(run)}};
  add_further(written, j);
  if (written.light) j["light"] = json_of(*written.light, *options.evaluation.further.light, *options.light);
  if (options.evaluation.max_error) j["max_error"] = error_budget_json(run, *options.evaluation.max_error);
  if (run.estimate) j["estimate"] = json_of(*run.estimate, written.output_bytes);
  add_accuracy_and_totals(run, j);
  if (run.outside_of_region > 0) j["outside_of_region"] = run.outside_of_region;
  if (written.skipped_features > 0) j["skipped_features"] = written.skipped_features;
  if (!written.notes.empty()) j["notes"] = written.notes;
  j["settings"] = Json::parse(options.run.settings_json);
  return j.dump(1) + "\n";
}

}  // namespace farlod
