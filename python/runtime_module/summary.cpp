// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/summary.hpp"

#include <pybind11/stl.h>

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

py::dict dict_of(const ErrorSummary& errors) {
  return py::dict("count"_a = errors.count, "rays"_a = errors.rays, "mean_abs_error"_a = errors.mean_abs_error,
                  "p99_abs_error"_a = errors.p99_abs_error, "max_abs_error"_a = errors.max_abs_error, "bias"_a = errors.bias);
}

py::dict dict_of(const BoundsWidth& width) { return py::dict("mean_width"_a = width.mean, "max_width"_a = width.max); }

py::dict dict_of(const RunEstimate& estimate) {
  constexpr double mib = 1 << 20;
  return py::dict("cells"_a = estimate.cells, "evaluated_cells"_a = estimate.evaluated_cells,
                  "evaluated_receivers"_a = estimate.evaluated_receivers, "receivers"_a = estimate.receivers,
                  "seconds"_a = estimate.seconds, "memory_mib"_a = estimate.memory_bytes / mib);
}

}  // namespace

py::dict summary_dict(const EvaluationSummary& run) {
  py::dict summary(
      "receivers"_a = run.receivers, "nodata"_a = run.no_data + run.beyond_grid, "outside_of_grid"_a = run.outside_of_grid,
      "outside_of_region"_a = run.outside_of_region, "receivers_without_far_map"_a = run.without_far_map,
      "receivers_by_rays"_a = run.by_rays, "receivers_near_buildings"_a = run.near_buildings,
      "azimuths"_a = run.accuracy.azimuths, "rays"_a = run.accuracy.rays, "rays_traced_exactly"_a = run.retraced_rays,
      "seconds"_a =
          py::dict("scenes"_a = run.seconds.scenes, "evaluate"_a = run.seconds.evaluate, "deliver"_a = run.seconds.deliver),
      "svf"_a = py::dict("min"_a = run.svf_min, "mean"_a = run.svf_mean, "median"_a = run.svf_median, "max"_a = run.svf_max,
                         "mean_near_buildings"_a = run.svf_mean_near_buildings));
  if (run.bounds) summary["bounds"] = dict_of(*run.bounds);
  if (run.svf_total)
    summary["svf_total"] = py::dict("min"_a = run.svf_total->min, "mean"_a = run.svf_total->mean, "max"_a = run.svf_total->max);
  if (run.svf_total_bounds) summary["svf_total_bounds"] = dict_of(*run.svf_total_bounds);
  if (run.estimate) summary["estimate"] = dict_of(*run.estimate);
  if (run.errors) summary["verify"] = dict_of(*run.errors);
  if (run.svf_total_errors) summary["svf_total_verify"] = dict_of(*run.svf_total_errors);
  return summary;
}

}  // namespace farlod
