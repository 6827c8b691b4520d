// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/run_report.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/quantity_options.hpp"
#include "console/progress.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/quantities.hpp"
#include "results/picture/value_scale.hpp"

namespace farlod {
namespace {

std::string counted(std::size_t receivers) { return fmt::format("{} receiver{}", receivers, receivers == 1 ? "" : "s"); }
const char* lie(std::size_t receivers) { return receivers == 1 ? "lies" : "lie"; }
const char* them(std::size_t receivers) { return receivers == 1 ? "it" : "them"; }

std::string mean_near_buildings(const EvaluationSummary& run) {
  if (!run.svf_mean_near_buildings) return {};
  return fmt::format("; mean within {:g} m of buildings {:.4f}", near_buildings_m, *run.svf_mean_near_buildings);
}

void print_values(const EvaluationSummary& run, const std::string& quantity) {
  if (run.svf_mean && run.receivers == 1)
    fmt::print("{}: {:.4f}\n", quantity, *run.svf_mean);
  else if (run.svf_mean)
    fmt::print("{}: min {:.4f}, mean {:.4f}, median {:.3f}, max {:.4f}{}\n", quantity, *run.svf_min, *run.svf_mean,
               *run.svf_median, *run.svf_max, mean_near_buildings(run));
  if (run.svf_mean && *run.svf_min == *run.svf_max && run.receivers > 100)
    fmt::print("Every receiver has the same value: is the package the right one, and the height above its roofs?\n");
}

/// Ranges of the further columns, unless they are too many to be read.
void print_further(const WrittenRun& written) {
  constexpr std::size_t most_columns = 12;
  const std::vector<std::optional<ValueRange>>& ranges = written.summary.further;
  if (ranges.size() > most_columns) return;
  const std::vector<ColumnDescription>& columns = written.further_columns;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    if (!ranges[k]) continue;
    const std::string sign = sign_of_unit(columns[k].unit), unit = (sign.empty() ? "" : " ") + sign;
    if (written.summary.receivers == 1)
      fmt::print("{}: {:.4g}{}\n", columns[k].name, ranges[k]->mean, unit);
    else
      fmt::print("{}: min {:.4g}, mean {:.4g}, max {:.4g}{}\n", columns[k].name, ranges[k]->min, ranges[k]->mean, ranges[k]->max,
                 unit);
  }
}

void print_errors(const char* of_what, const ErrorSummary& e) {
  fmt::print("Errors{} against exact ({} random receivers, {} rays): mean {:.4f}, 99 % within {:.4f}, max {:.4f}, bias {:+.4f}\n",
             of_what, e.count, e.rays, e.mean_abs_error, e.p99_abs_error, e.max_abs_error, e.bias);
}

/// How exact the answers are, as far as somebody asked.
void print_accuracy(const EvaluationSummary& run, const EvaluationSettings& asked) {
  constexpr double wide = 0.05;
  if (asked.max_error)
    fmt::print(
        "Error of {:g} at the most: {} azimuths, {} rays where there are no horizons, {} parts of the sky decided by the whole "
        "city\n",
        *asked.max_error, run.accuracy.azimuths, run.accuracy.rays, run.retraced_rays);
  if (run.bounds)
    fmt::print(
        "Certain intervals: {:.4f} wide on average, {:.4f} at the most{}\n", run.bounds->mean, run.bounds->max,
        !asked.max_error && run.bounds->max > wide ? ", as below overhangs and in recesses (--max-error narrows them)" : "");
  if (run.svf_total_bounds)
    fmt::print("Certain intervals of svf_total: {:.4f} wide on average, {:.4f} at the most\n", run.svf_total_bounds->mean,
               run.svf_total_bounds->max);
  if (run.errors) print_errors("", *run.errors);
  if (run.svf_total_errors) print_errors(" of svf_total", *run.svf_total_errors);
}

void print_estimate(const WrittenRun& written, const RunEstimate& estimate) {
  constexpr double mib = 1 << 20;
  const double receivers = rough_number(estimate.receivers);
  fmt::print(
      "About {} receiver{} in {} cell{}: {}, {} of memory and {} on the disk, by the time that {} in {} of them took. Nothing "
      "was written.\n",
      with_commas(static_cast<std::uint64_t>(receivers)), receivers == 1.0 ? "" : "s", with_commas(estimate.cells),
      estimate.cells == 1 ? "" : "s", rough_duration(estimate.seconds), rough_size(estimate.memory_bytes / mib),
      rough_size(written.output_bytes / mib), counted(estimate.evaluated_receivers), estimate.evaluated_cells);
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
}

void print_matrix(const WrittenMatrix& matrix) {
  const MatrixFigures& f = matrix.figures;
  fmt::print(
      "Matrix: {} surfaces, {} entries, {:.1f} s. Before it was made reciprocal, pairs differed by {:.2g} on average, {:.2g} at "
      "the most; rows changed by {:.2g}, {:.2g} at the most; below the threshold: {:.2g}, {:.2g} at the most\n",
      with_commas(matrix.surfaces), with_commas(matrix.entries), matrix.seconds, f.reciprocity_mean, f.reciprocity_max,
      f.closure_mean, f.closure_max, f.dropped_mean, f.dropped_max);
}

/// Why receivers have no data. Those on surfaces stand right before them: nobody chose a place inside a building.
const char* reason_of_no_data(ReceiverSource source) {
  return source == ReceiverSource::surfaces ? "where another building or the ground covers the surface (party walls, cellars)"
                                            : "inside buildings or without ground";
}

/// Why pixels or points were not asked for, though the extent holds them.
std::string reason_of_left_out(const SvfOptions& options) {
  if (!options.evaluation.within_m) return "outside of the mask or box";
  const std::string farther = fmt::format("farther than {:g} m from buildings", *options.evaluation.within_m);
  return options.mask_file.empty() ? farther : "outside of the mask, or " + farther;
}

void print_run(const WrittenRun& written, const SvfOptions& options, double total_s) {
  const EvaluationSummary& run = written.summary;
  const EvaluationSettings& asked = options.evaluation;
  fmt::print("{}, {:.1f} s in all; no data: {} {}", counted(run.receivers), total_s, run.no_data,
             reason_of_no_data(options.source));
  if (run.beyond_grid > 0) fmt::print(", {} beyond the grid", run.beyond_grid);
  if (run.outside_of_region > 0) fmt::print("; {} {}", run.outside_of_region, reason_of_left_out(options));
  fmt::print("\n");
  print_values(run, quantity_name(asked.weight));
  print_further(written);
  if (run.outside_of_grid > 0 && options.source != ReceiverSource::at)  // a note tells of that place
    fmt::print("{} around the grid of cells {} answered by horizons or rays of the whole city: only cells have far maps.\n",
               counted(run.outside_of_grid), run.outside_of_grid == 1 ? "was" : "were");
  if (run.without_far_map > 0)
    fmt::print("{} {} in cells without a far map: rays against the whole city answered {}. farlod-pack --area adds far maps.\n",
               counted(run.without_far_map), lie(run.without_far_map), them(run.without_far_map));
  if (asked.engine == Engine::automatic && asked.max_error && run.by_rays > 0)
    fmt::print("{} of the receivers needed the whole city: their bounds were wider than allowed.\n", run.by_rays);
  print_accuracy(run, asked);
  if (written.matrix) print_matrix(*written.matrix);
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
  for (const auto& file : written.files) fmt::print("{}\n", file.string());
}

void print_shard(const WrittenRun& written, const SvfOptions& options, double total_s) {
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
  fmt::print("Shard {}/{} of {}: {}, {:.1f} s. Once all are done, the same command with --merge writes it.\n",
             options.shard->index, options.shard->count, options.output.string(), counted(written.summary.receivers), total_s);
}

}  // namespace

void print_report(const WrittenRun& written, const SvfOptions& options, double total_s) {
  if (written.summary.estimate)
    print_estimate(written, *written.summary.estimate);
  else if (options.shard)
    print_shard(written, options, total_s);
  else
    print_run(written, options, total_s);
}

}  // namespace farlod
