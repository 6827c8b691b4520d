// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/asked_of_city.hpp"
#include "app/files_of_run.hpp"
#include "app/light_of_package.hpp"
#include "app/quantity_options.hpp"
#include "app/region_of_package.hpp"
#include "app/result_key.hpp"
#include "app/run_histogram.hpp"
#include "app/run_notes.hpp"
#include "app/run_report.hpp"
#include "app/svf_options.hpp"
#include "app/svf_summary.hpp"
#include "app/written_run.hpp"
#include "base/durable_file.hpp"
#include "console/progress.hpp"
#include "console/run_program.hpp"
#include "farlod/answer_file.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"
#include "farlod/surfaces.hpp"
#include "results/city/enriched_city_files.hpp"
#include "results/picture/error_map.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/table/sky_table_csv.hpp"

namespace farlod {
namespace {

void write_map(const Package& package, const SvfOptions& options, std::size_t threads, const WrittenRun& written) {
  const PackageDescription& city = package.description();
  const EvaluationSummary& run = written.summary;
  const GreyMap map = written.grey_map ? *written.grey_map : map_around(run.verified, city.outline_projected);
  const ErrorMapCaption caption{quantity_name(options.evaluation.weight),
                                city.epsg ? "EPSG:" + std::to_string(*city.epsg) : city.crs_name};
  const PlanBackground background = plan_background(package, map.plan(), threads);
  write_drawing(draw_error_map(map, background.outlines, run.verified, *run.errors, caption), options.verify_file);
}

/// Writes what --verify found out as --verify-map asks for it, a picture or a table, and adds the file to those of the run.
void write_verification(const Package& package, const SvfOptions& options, std::size_t threads, WrittenRun& written) {
  written.write_s += seconds_of([&] {
    if (options.verify_format->is_picture)
      write_map(package, options, threads, written);
    else
      write_verification_csv(written.summary.verified, quantity_name(options.evaluation.weight), options.verify_file);
  });
  written.files.emplace_back(options.verify_file);
}

/// The folder beside an output, OUT.unfinished, in which a run keeps the answers that it has, for the case that it does not come
/// to its end: the same command goes on from there. Shards keep theirs in it, until they are merged.
///   answers                  of a run that is no shard
///   3_of_8.answers, .done    of a shard, and that it has all of its answers
class KeptWork {
 public:
  /// Opens what is to be kept, or what is to be merged. Throws OutputError, which names the option that differs or the shard that
  /// is missing; Busy.
  KeptWork(const SvfOptions& options, const PackageDescription& package);
  KeptWork(const KeptWork&) = delete;
  KeptWork& operator=(const KeptWork&) = delete;
  /// Removes the folder where it holds no answers.
  ~KeptWork();

  /// Tells a run what is kept, and which part of the work it has.
  void tell(RunSettings& run) const;
  /// What was found, for the user; empty if nothing.
  [[nodiscard]] const std::string& finding() const { return finding_; }
  /// The output is written, or the shard has all of its answers.
  void finish();

 private:
  void open_own(const SvfOptions& options, const AnswerKey& key);
  void open_shards(const SvfOptions& options, const AnswerKey& key);

  std::filesystem::path folder_;
  std::optional<Shard> shard_;
  std::shared_ptr<AnswerFile> answers_;  ///< null where nothing is kept
  std::string finding_;
};

namespace fs = std::filesystem;

std::string name_of(Shard shard) { return fmt::format("{}_of_{}", shard.index, shard.count); }

/// How many shards there are by the names of their files.
std::set<std::size_t> shard_counts_in(const fs::path& folder) {
  static const std::regex of_shard(R"([0-9]+_of_([0-9]+)\.(answers|done))");
  std::set<std::size_t> counts;
  std::error_code unread;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unread)) {
    std::smatch match;
    const std::string name = entry.path().filename().string();
    if (std::regex_match(name, match, of_shard)) counts.insert(std::stoul(match[1]));
  }
  return counts;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, error.message());
}

KeptWork::KeptWork(const SvfOptions& options, const PackageDescription& package)
    : folder_(options.output.string() + ".unfinished"), shard_(options.shard) {
  if (!options.keeps_answers()) return;
  const AnswerKey key = key_of_answers(options, package);
  options.merge ? open_shards(options, key) : open_own(options, key);
}

void KeptWork::open_own(const SvfOptions& options, const AnswerKey& key) {
  make_folder(folder_);
  const auto of_another = options.resume || shard_ ? AnswerFile::OfAnotherKey::refuse : AnswerFile::OfAnotherKey::replace;
  if (shard_) {
    for (const std::size_t count : shard_counts_in(folder_))
      if (count != shard_->count)
        throw OutputError(
            fmt::format("{} is being computed in {} shards, and --shard says {}: give the same number to all, or "
                        "remove {}.",
                        options.output.string(), count, shard_->count, folder_.string()));
  }
  const fs::path file = folder_ / (shard_ ? name_of(*shard_) + ".answers" : "answers");
  answers_ = std::make_shared<AnswerFile>(AnswerFile::open(file, key, of_another));
  if (!answers_->replaced().empty())
    finding_ = "Removed what an earlier run had left of other answers (" + answers_->replaced() + ").";
  else if (answers_->cells() > 0)
    finding_ = fmt::format("Going on with what an earlier run has left: the answers of {} cells.", answers_->cells());
}

void KeptWork::open_shards(const SvfOptions& options, const AnswerKey& key) {
  const std::set<std::size_t> counts = shard_counts_in(folder_);
  if (counts.empty())
    throw OutputError(
        fmt::format("there is nothing to merge into {}: no shard has computed a part of it (--shard).", options.output.string()));
  if (counts.size() > 1)
    throw OutputError(fmt::format("{} holds shards of {} and of {}: remove those that are not wanted.", folder_.string(),
                                  *counts.begin(), *counts.rbegin()));
  std::vector<fs::path> files;
  std::string missing;
  for (Shard shard{0, *counts.begin()}; shard.index < shard.count; ++shard.index) {
    files.push_back(folder_ / (name_of(shard) + ".answers"));
    if (!fs::exists(folder_ / (name_of(shard) + ".done")))
      missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", shard.index, shard.count);
  }
  if (!missing.empty())
    throw OutputError(
        fmt::format("{} is not complete: these shards are missing: {}. Run them, then merge.", options.output.string(), missing));
  answers_ = std::make_shared<AnswerFile>(AnswerFile::together(files, key));
}

KeptWork::~KeptWork() {
  if (!answers_) return;
  const bool is_own = !answers_->is_read_only();
  if (!is_own || answers_->cells() > 0) return;
  std::error_code ignored;
  fs::remove(folder_ / (shard_ ? name_of(*shard_) + ".answers" : "answers"), ignored);
  fs::remove(folder_, ignored);  // where it is empty now
}

void KeptWork::tell(RunSettings& run) const {
  run.answers = answers_;
  run.shard = shard_;
}

void KeptWork::finish() {
  if (!answers_) return;
  if (shard_) return write_durably(folder_ / (name_of(*shard_) + ".done"), std::string_view(""));
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  answers_.reset();
}

/// The run of --city: writes the file, or the files, that the package was made of again, with the values as attributes of its
/// buildings and semantic surfaces. Throws InputError before the work where the file is another one, and what the library throws.
WrittenRun write_enriched_city(const Package& package, const SvfOptions& options, const RunSettings& run) {
  const EnrichedCityFiles city(
      package, options.package.string(), options.city_file,
      {quantity_name(options.evaluation.weight), BoundsColumns::no, column_descriptions_of(options.evaluation.further),
       options.surfaces.irradiation_threshold_kwh_m2 ? ThresholdColumns::yes : ThresholdColumns::no});
  city.require_fitting(options.output);
  RunHistogram histogram(options);
  const OnSurfacePoints count = [&histogram](std::size_t, std::span<const SurfacePoint> points) { histogram.add(points); };
  const SurfaceMeans means =
      evaluate_surfaces(package, options.surfaces, options.evaluation, histogram.is_wanted() ? count : OnSurfacePoints{}, run);
  WrittenRun written{means.summary};
  written.output_bytes = city.bytes();
  if (!options.writes()) return written;
  require_answers(written.summary, options, package.description());
  written.files = {options.output};
  const auto start = std::chrono::steady_clock::now();
  written.notes = city.write(package, means, options.output);
  histogram.write(options);
  written.write_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return written;
}

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

/// What was kept of a run that has no answers is not worth to go on with.
WrittenRun write_or_forget(const Package& package, const SvfOptions& options, const RunSettings& run, KeptWork& kept,
                           const std::optional<BoxInDegrees>& box) {
  try {
    WrittenRun written = write(package, options, run);
    if (options.evaluation.dry_run) require_answers(written.summary, options, package.description());
    return written;
  } catch (const NoAnswer& error) {
    kept.finish();
    if (!box) throw;
    throw NoAnswer(error.what() + box->beside);
  }
}

/// With what is to be told of a box in degrees, if there is one.
void add_light(const std::optional<PeriodLight>& light, const std::optional<BoxInDegrees>& box, WrittenRun& written) {
  if (box && !box->note.empty()) written.notes.insert(written.notes.begin(), box->note);
  written.light = light;
  if (!light) return;
  const std::vector<std::string> notes = notes_of(*light);
  written.notes.insert(written.notes.begin(), notes.begin(), notes.end());
}

/// Adds what depends on the package: what SOLWEIG reads of trees, and svf_total where nobody said what to compute, there is room
/// for it, and no error is to be kept, which takes rays for crowns.
void add_quantities_for(bool has_trees, SvfOptions& o) {
  if (o.format == nullptr) return;
  Quantities& further = o.evaluation.further;
  add_for_solweig(*o.format, has_trees, further);
  const bool has_room = o.format->holds_bounds || (o.format->is_picture && o.source == ReceiverSource::grid);
  const bool is_sky = o.source == ReceiverSource::at && o.format->is_picture;
  if (!has_trees || !(has_room || is_sky)) return;
  further.sunlit_total = further.sunlit_total || o.sunshine.has_value();
  if ((o.names_quantities && !is_sky) || o.evaluation.max_error || o.evaluation.weight != SkyWeight::cosine) return;
  further.svf_total = true;
  further.svf_total_bounds = o.evaluation.bounds;
}

WrittenRun evaluate(SvfOptions options) {
  const auto start = Clock::now();
  const Package package(options.package);
  const double open_s = seconds_since(start);
  require_buildings_for(options, package);
  const std::optional<BoxInDegrees> box = take_degrees_of_bbox(options, package.description());
  options.evaluation.region = region_of_package(options, package.description());
  const std::optional<PeriodLight> light = place_light(package, options);
  add_quantities_for(inventory_of(package).crowns.all() > 0, options);
  ProgressLine progress("sky view factors", options.run.verbosity);
  KeptWork kept(options, package.description());
  RunSettings run = run_settings(options, progress);
  kept.tell(run);
  WrittenRun written = write_or_forget(package, options, run, kept, box);
  written.further_columns = column_descriptions_of(options.evaluation.further);
  written.open_s = open_s;
  add_light(light, box, written);
  if (!kept.finding().empty()) written.notes.insert(written.notes.begin(), kept.finding());
  for (std::string& note : notes_of_run(package, options, written.summary)) written.notes.push_back(std::move(note));
  if (options.shard) kept.finish();
  if (!options.writes()) return written;
  if (!options.histogram_file.empty()) written.files.emplace_back(options.histogram_file);
  if (options.verify_format != nullptr) write_verification(package, options, run.threads, written);
  kept.finish();
  return written;
}

int run(const SvfOptions& options) {
  // The process is the program's: as many threads as are asked for, also where there are fewer cores
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, thread_count(options.run));
  // oneTBB looks for libraries when it is first used, and would wait until that of GDAL is loaded, which a thread begins soon
  oneapi::tbb::task_arena().initialize();
  require_outputs(options);
  const auto start = Clock::now();
  const WrittenRun result = evaluate(options);
  const double total_s = seconds_since(start);
  write_text(options.run.summary_file, svf_summary_json(result, options, total_s));
  if (options.run.verbosity != Verbosity::normal) return exit_done;
  print_report(result, options, total_s);
  return exit_done;
}

}  // namespace

}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  const Interruption interruption;
  use_bundled_fonts();
  ProgramName program{.name = "farlod-svf",
                      .when_interrupted = "Nothing was kept.",
                      .when_out_of_memory = "Evaluate a part at a time (--bbox), or use fewer --threads.",
                      // The library tells what is needed; what decides it are options of this program
                      .at_limit =
                          " The limit is --memory-limit; --threads, --grid and --bbox decide what is needed; --engine "
                          "exact, --verify and --max-error trace the whole city."};
  return run_program(program, [&] {
    const ParsedSvfOptions parsed = parse_svf_options(argc, argv);
    if (parsed.options && parsed.options->keeps_answers())
      program.when_interrupted = "The answers so far are kept: the same command goes on with them.";
    return parsed.options ? run(*parsed.options) : parsed.exit_code;
  });
}
