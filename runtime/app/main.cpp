// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <filesystem>

#include "app/enriched_city.hpp"
#include "app/kept_work.hpp"
#include "app/quantity_options.hpp"
#include "app/region_of_package.hpp"
#include "app/sun_of_package.hpp"
#include "app/svf_options.hpp"
#include "app/svf_summary.hpp"
#include "app/verification_file.hpp"
#include "app/written_run.hpp"
#include "console/bundled_fonts.hpp"
#include "console/interruption.hpp"
#include "console/output_files.hpp"
#include "console/rough_number.hpp"
#include "console/run_program.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

RunSettings run_settings(const SvfOptions& options, ProgressLine& progress) {
  RunSettings run;
  run.stop = Interruption::token();
  run.threads = thread_count(options.run);
  run.memory_limit_mib = options.memory_limit_mib;
  if (!options.evaluation.dry_run) run.on_progress = [&progress](const Progress& p) { progress.update(p.done, p.all); };
  return run;
}

WrittenRun write(const Package& package, const SvfOptions& options, const RunSettings& run) {
  if (!options.city_file.empty()) return write_enriched_city(package, options, run);
  if (options.source == ReceiverSource::at && options.format->is_picture) return write_sky(package, options, run);
  if (options.source == ReceiverSource::grid) return write_raster(package, options, run);
  if (options.source == ReceiverSource::surfaces) return write_surfaces(package, options, run);
  return write_points(package, options, run);
}

WrittenRun evaluate(SvfOptions options) {
  const auto start = Clock::now();
  const Package package(options.package);
  const double open_s = seconds_since(start);
  options.evaluation.region = region_of_package(options, package.description());
  if (options.sunshine) options.evaluation.further.sun = sun_of_package(package.description(), *options.sunshine);
  if (options.format != nullptr && options.format->is_for_solweig)
    add_for_solweig(inventory_of(package).crowns.all() > 0, options.evaluation.further);
  ProgressLine progress("sky view factors", options.run.verbosity);
  KeptWork kept(options, package.description());
  RunSettings run = run_settings(options, progress);
  kept.tell(run);
  WrittenRun written = write(package, options, run);
  written.further_columns = columns_of(options.evaluation.further);
  written.open_s = open_s;
  if (!kept.finding().empty()) written.notes.insert(written.notes.begin(), kept.finding());
  if (options.evaluation.dry_run) return written;
  if (options.shard) {
    kept.finish();
    return written;
  }
  if (!options.histogram_file.empty()) written.files.emplace_back(options.histogram_file);
  if (options.verify_format != nullptr) write_verification(package, options, run.threads, written);
  kept.finish();
  return written;
}

void print_values(const EvaluationSummary& run, const std::string& quantity) {
  if (run.svf_mean) fmt::print("{}: min {:.4f}, mean {:.4f}, max {:.4f}\n", quantity, *run.svf_min, *run.svf_mean, *run.svf_max);
  if (run.svf_total)
    fmt::print("svf_total: min {:.4f}, mean {:.4f}, max {:.4f}\n", run.svf_total->min, run.svf_total->mean, run.svf_total->max);
}

void print_sanity(const EvaluationSummary& run) {
  if (!run.svf_mean)
    return fmt::print("No receiver has an answer: all of them lie inside buildings or outside of the package.\n");
  if (*run.svf_min == *run.svf_max && run.receivers > 100)
    fmt::print("Every receiver has the same value: is the package the right one, and the height above its roofs?\n");
}

void print_errors(const char* of_what, const ErrorSummary& e) {
  fmt::print("Errors{} against exact ({} random receivers, {} rays): mean {:.4f}, 99 % within {:.4f}, max {:.4f}, bias {:+.4f}\n",
             of_what, e.count, e.rays, e.mean_abs_error, e.p99_abs_error, e.max_abs_error, e.bias);
}

/// How exact the answers are, as far as somebody asked.
void print_accuracy(const EvaluationSummary& run, const EvaluationSettings& asked) {
  if (asked.max_error)
    fmt::print(
        "Error of {:g} at the most: {} azimuths, {} rays where horizons are not enough, {} rays traced against the whole city\n",
        *asked.max_error, run.accuracy.azimuths, run.accuracy.rays, run.retraced_rays);
  if (run.bounds)
    fmt::print("Certain intervals: {:.4f} wide on average, {:.4f} at the most\n", run.bounds->mean, run.bounds->max);
  if (run.svf_total_bounds)
    fmt::print("Certain intervals of svf_total: {:.4f} wide on average, {:.4f} at the most\n", run.svf_total_bounds->mean,
               run.svf_total_bounds->max);
  if (run.errors) print_errors("", *run.errors);
  if (run.svf_total_errors) print_errors(" of svf_total", *run.svf_total_errors);
}

void print_estimate(const WrittenRun& written, const RunEstimate& estimate) {
  constexpr double mib = 1 << 20;
  fmt::print("About {} receivers: {}, {} of memory and {} on the disk, from {} of {} cells. Nothing was written.\n",
             with_commas(static_cast<std::uint64_t>(rough_number(estimate.receivers))), rough_duration(estimate.seconds),
             rough_size(estimate.memory_bytes / mib), rough_size(written.output_bytes / mib), estimate.evaluated_cells,
             with_commas(estimate.cells));
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
}

void print_run(const WrittenRun& written, const SvfOptions& options, double total_s) {
  const EvaluationSummary& run = written.summary;
  const EvaluationSettings& asked = options.evaluation;
  fmt::print("{} receivers, {:.1f} s in all; no data: {} inside buildings or without ground", run.receivers, total_s,
             run.no_data);
  if (run.beyond_grid > 0) fmt::print(", {} beyond the grid", run.beyond_grid);
  if (run.outside_of_region > 0) fmt::print("; {} outside of the mask or box", run.outside_of_region);
  fmt::print("\n");
  print_values(run, quantity_name(asked.weight));
  print_sanity(run);
  if (run.outside_of_grid > 0)
    fmt::print("{} receivers lie outside of the grid, where there is no far map: they were traced against the whole city.\n",
               run.outside_of_grid);
  if (run.without_far_map > 0)
    fmt::print(
        "{} receivers lie in cells without a far map: they were traced against the whole city. farlod-pack --area adds far "
        "maps.\n",
        run.without_far_map);
  if (asked.engine == Engine::automatic && run.by_rays > 0)
    fmt::print(
        "{} of the receivers needed rays ({} each at the most, about): they may see sky below something that overhangs{}.\n",
        run.by_rays, run.accuracy.rays, asked.max_error ? ", or the far map leaves them more uncertain than allowed" : "");
  print_accuracy(run, asked);
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
  for (const auto& file : written.files) fmt::print("{}\n", file.string());
}

void print_shard(const WrittenRun& written, const SvfOptions& options, double total_s) {
  for (const std::string& note : written.notes) fmt::print("{}\n", note);
  fmt::print("Shard {}/{} of {}: {} receivers, {:.1f} s. Once all are done, the same command with --merge writes it.\n",
             options.shard->index, options.shard->count, options.output.string(), written.summary.receivers, total_s);
}

int run(const SvfOptions& options) {
  // The process is the program's: as many threads as are asked for, also where there are fewer cores
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, thread_count(options.run));
  // oneTBB looks for libraries when it is first used, and would wait until that of GDAL is loaded, which a thread begins soon
  oneapi::tbb::task_arena().initialize();
  for (const std::filesystem::path& file :
       {options.output, std::filesystem::path(options.preview_file), std::filesystem::path(options.verify_file),
        std::filesystem::path(options.histogram_file), std::filesystem::path(options.run.summary_file)})
    require_folder_of(file);
  const auto start = Clock::now();
  const WrittenRun result = evaluate(options);
  const double total_s = seconds_since(start);
  write_text(options.run.summary_file, svf_summary_json(result, options, total_s));
  if (options.run.verbosity != Verbosity::normal) return exit_done;
  if (result.summary.estimate)
    print_estimate(result, *result.summary.estimate);
  else if (options.shard)
    print_shard(result, options, total_s);
  else
    print_run(result, options, total_s);
  return exit_done;
}

}  // namespace
}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  const Interruption interruption;
  use_bundled_fonts();
  return run_program({.name = "farlod-svf",
                      .when_interrupted = "The answers so far are kept: the same command goes on with them.",
                      .when_out_of_memory = "Evaluate a part at a time (--bbox), or use fewer --threads.",
                      // The library tells what is needed; what decides it are options of this program
                      .at_limit = " The limit is --memory-limit; --threads, --grid and --bbox decide what is needed; --engine "
                                  "exact, --verify and --max-error trace the whole city."},
                     [&] {
                       const ParsedSvfOptions parsed = parse_svf_options(argc, argv);
                       return parsed.options ? run(*parsed.options) : parsed.exit_code;
                     });
}
