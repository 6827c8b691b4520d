// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <malloc.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/pack_options.hpp"
#include "console/named_files.hpp"
#include "console/progress.hpp"
#include "console/run_program.hpp"
#include "farlod/error.hpp"
#include "farlod/pack.hpp"

namespace farlod {
namespace {

/// What is told before the long work: a line, rounded to what an estimate can know.
std::string estimate_text(const PackEstimate& e) {
  const std::string to_make = e.far_maps == 0 ? ", no far maps to make" : ", far maps to make for " + with_commas(e.far_maps);
  const std::string far_maps = e.far_maps < e.cells ? to_make : "";
  return fmt::format("{} cells{}: about {} from here on, {} of memory, and a package of {}", with_commas(e.cells), far_maps,
                     rough_duration(e.seconds), rough_size(e.memory_mib), rough_size(e.package_mib));
}

void write_report(const Report& report, const std::string& path) {
  write_text(path, std::filesystem::path(path).extension() == ".geojson" ? report_geojson(report) : report_json(report));
}

/// What --strict says.
InputError refusal(const ProblemsRefused& refused, const std::string& report_file) {
  const std::string list = report_file.empty() ? "--report FILE.json lists each of them" : report_file + " lists them one by one";
  return InputError(std::string(refused.what()) + ", and --strict allows none: no package is written; " + list + ".");
}

std::string file_and_detail(const Problem& p) { return p.source.empty() ? p.detail : p.source + ": " + p.detail; }

/// The doubts of a city that were told before the long work, each by its file and detail.
using ToldDoubts = std::set<std::string>;

/// What a problem says of whole files, which the count of files does not tell.
void print_files(const Report& report, ProblemCode code, const ToldDoubts& told) {
  constexpr std::size_t most_files = 3;
  std::size_t files = 0;
  for (const Problem& p : report.problems())
    if (p.code == code && p.place == "the whole file" && !told.contains(file_and_detail(p)) && files++ < most_files)
      fmt::print("           {}\n", file_and_detail(p));
  if (files > most_files) fmt::print("           and {} more files\n", files - most_files);
}

/// A line for each kind of problem, so that nothing is lost silently; --report has them one by one.
void print_problems(const Report& report, const std::string& report_file, const ToldDoubts& told) {
  std::map<ProblemCode, std::size_t> counts, told_counts;
  for (const Problem& p : report.problems()) {
    ++counts[p.code];
    if (told.contains(file_and_detail(p))) ++told_counts[p.code];
  }
  for (const auto& [code, count] : counts) {
    const ProblemDescription& d = describe(code);
    fmt::print("  {:>6} × {} {}: {} ({}{})\n", count, static_cast<int>(code), d.slug, d.summary, name_of(d.effect),
               told_counts[code] == 0 ? "" : "; doubted above");
    print_files(report, code, told);
  }
  if (!counts.empty() && report_file.empty()) fmt::print("  --report FILE.json lists each of them.\n");
}

/// What makes the whole city doubtful, with what would explain it: before the work, which may take hours and be in vain; or with
/// what ends the run, unless that says it itself. Each is told once.
void print_doubts(std::FILE* out, const Report& report, ToldDoubts& told, std::string_view reason = {}) {
  const auto is_doubt = [](const Problem& p) { return doubts_the_model(p.code); };
  const auto is_said = [&](const Problem& p) { return is_doubt(p) && reason.find(p.detail) != reason.npos; };
  if (std::ranges::any_of(report.problems(), is_said)) return;
  for (const Problem& p : report.problems())
    if (is_doubt(p) && told.insert(file_and_detail(p)).second)
      fmt::print(out, "Doubtful ({} {}): {}\n", static_cast<int>(p.code), describe(p.code).slug, file_and_detail(p));
}

/// What the files hold besides buildings and ground, most of it first.
void print_skipped(const SkippedFeatures& skipped) {
  std::vector<std::pair<std::string, std::uint64_t>> rows(skipped.begin(), skipped.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t most_rows = 6;
  for (std::size_t n = 0; n < std::min(rows.size(), most_rows); ++n)
    fmt::print("{}{} {}", n == 0 ? "Not used: " : ", ", rows[n].second, rows[n].first);
  if (rows.size() > most_rows) fmt::print(" and {} other kinds (--summary lists all)", rows.size() - most_rows);
  if (!rows.empty()) fmt::print("\n");
}

/// Why the surfaces of streets and gardens are not the ground, where nothing surveyed is.
void print_unused_ground(const SkippedFeatures& skipped, const CityLooks& looks) {
  constexpr std::array level_things{"Road", "Railway", "Square", "TransportSquare", "LandUse", "PlantCover", "WaterBody"};
  const bool is_surveyed =
      looks.ground && (looks.ground->source == GroundSource::terrain || looks.ground->source == GroundSource::relief);
  std::string names;
  for (const char* name : level_things)
    if (skipped.contains(name)) names += (names.empty() ? "" : ", ") + std::string(name);
  if (looks.ground && !is_surveyed && !names.empty())
    fmt::print("  {} are not taken as ground, since many models draw them at height 0: --terrain DEM tells its heights.\n",
               names);
}

void print_choice(const ChosenGrid& chosen, const PackOptions& options) {
  const double max_error = options.settings.max_error.value_or(0.0);
  if (chosen.best) {
    const GridChoice& b = *chosen.best;
    fmt::print(
        "Chosen for errors up to {:g}: cells of {:g} m, neighborhood {} × {}, far maps to {:g}; expected of the far maps: "
        "at the most {:.4f}, certain to {:.4f} for 99 %\n",
        max_error, b.cell_edge_m, b.neighborhood, b.neighborhood, b.tolerance, b.far_error.max_error, b.far_error.p99_half_width);
  } else {
    fmt::print(
        "No cells and no neighborhood keep an error of {:g} with far maps alone: farlod-svf --max-error {:g} will trace more "
        "rays exactly.\n",
        max_error, max_error);
  }
  const FarErrorEstimate& m = chosen.measured;
  fmt::print("Measured on {} other random receivers against exact: mean {:.4f}, at the most {:.4f}, certain to {:.4f} for 99 %\n",
             m.receivers, m.mean_error, m.max_error, m.p99_half_width);
}

/// A package, or what a shard has made of one.
void print_end(const PackResult& result, const PackOptions& options, double seconds) {
  const std::string output = options.settings.output.string();
  if (const auto& shard = options.settings.shard)
    return fmt::print(
        "Shard {}/{} of {}: {} blocks ({} of them were finished before), {:.1f} s. Once all are done: farlod-pack --merge "
        "-o {}\n",
        shard->index, shard->count, output, result.blocks, result.blocks_found, seconds, output);
  if (result.blocks_found > 0) fmt::print("{} of {} blocks were finished before.\n", result.blocks_found, result.blocks);
  fmt::print("{}: {:.1f} MiB ({:.1f} MiB far maps), {} triangles, {:.1f} s\n", output,
             static_cast<double>(result.package_bytes) / 1048576.0, static_cast<double>(result.far_map_bytes) / 1048576.0,
             result.package.triangles, seconds);
}

/// A terrain of another datum lies above or below where buildings say that they stand.
std::string text_of_feet(const CityLooks::Ground& ground) {
  if (!ground.feet) return "";
  const auto text = [](double above_m) {
    return fmt::format("{:.1f} m {}", std::abs(above_m), above_m < 0.0 ? "below" : "above");
  };
  const auto& [lowest_m, median_m, highest_m] = ground.feet->above_m;
  if (lowest_m == highest_m) return fmt::format("; all buildings begin {} it", text(median_m));
  return fmt::format("; buildings begin {} it (median; from {}, {}, to {}, {})", text(median_m), text(lowest_m),
                     ground.feet->lowest_id, text(highest_m), ground.feet->highest_id);
}

/// What a person looks at to see whether it is the right city.
void print_looks(const CityLooks& looks) {
  if (const auto& p = looks.lon_lat_deg)
    fmt::print("Place: latitude {:.4f}, longitude {:.4f}{}\n", p->y, p->x,
               looks.country.empty() ? "" : " (" + looks.country + ")");
  const bool is_surface = looks.ground && looks.ground->source == GroundSource::surface;
  if (const auto& h = looks.heights)
    fmt::print("Heights{}: least {:.1f} m, median {:.1f} m, tallest {:.1f} m\n", is_surface ? " of walls" : "", h->least_m,
               h->median_m, h->tallest_m);
  else if (is_surface)
    fmt::print("Heights of walls: none, since slopes stand between all pixels\n");
  if (const auto& g = looks.ground; g && g->source == GroundSource::nothing)
    fmt::print("Ground: flat, since neither the files nor a terrain tell it\n");
  else if (g)
    fmt::print("Ground{}: {:.1f} m to {:.1f} m, from the {}{}\n", is_surface && looks.heights ? " and roofs" : "", g->low_m,
               g->high_m, name_of(g->source), text_of_feet(*g));
}

/// How many buildings are missing; the lines above it say why.
void print_left_out(const Report& report, std::uint64_t kept) {
  const std::size_t left_out = buildings_left_out(report);
  if (left_out == 0) return;
  const auto lacks_height = [](const Problem& p) { return p.code == ProblemCode::no_height; };
  const bool is_height = std::ranges::any_of(report.problems(), lacks_height);
  fmt::print("  That is {} of {} buildings left out ({:.1f} %){}.\n", left_out, left_out + kept,
             100.0 * static_cast<double>(left_out) / static_cast<double>(left_out + kept),
             is_height ? "; --default-height keeps footprints without a height" : "");
}

/// What a city without buildings of its own is made of.
std::string name_of_ground_alone(const CityLooks& looks) {
  if (looks.ground->source != GroundSource::surface) return fmt::format("A {}, and no buildings", name_of(looks.ground->source));
  return looks.heights ? "A surface model; buildings are a part of it" : "A surface model without walls";
}

void print_contents(const PackResult& result, std::size_t problems) {
  const PackageDescription& m = result.package;
  if (m.buildings == 0 && result.looks.ground)
    fmt::print("{}", name_of_ground_alone(result.looks));
  else
    fmt::print("{} buildings, {} polygons", m.buildings, m.polygons);
  if (result.facets > m.polygons) fmt::print(" (planar faces of {} facets)", result.facets);
  fmt::print(", {} {}\n", problems, problems == 1 ? "problem" : "problems");
}

void print_result(const PackResult& result, const Report& report, const PackOptions& options, const ToldDoubts& told,
                  double seconds) {
  const PackageDescription& m = result.package;
  print_contents(result, report.problems().size());
  if (result.crowns != CrownCounts{} || options.settings.trees.any())
    fmt::print("Crowns: {} of trees, {} of cells of a canopy\n", result.crowns.of_trees, result.crowns.of_canopy);
  print_problems(report, options.report_file, told);
  print_left_out(report, m.buildings);
  print_skipped(result.skipped);
  print_unused_ground(result.skipped, result.looks);
  for (const std::string& note : result.notes) fmt::print("{}\n", note);
  print_looks(result.looks);
  fmt::print("CRS: {}\n", m.crs_name);
  if (m.buildings > 0)
    fmt::print("Streets: {:.2f}° from grid north ({:.2f}° from true north), strength {:.2f}\n", result.street_bearing.degrees(),
               (result.street_bearing + m.convergence).degrees(), result.alignment_strength);
  fmt::print("Grid: turned by {:.2f}°, {} × {} cells of {:g} m, neighborhood {} × {}\n", m.grid_bearing.degrees(), m.columns,
             m.rows, m.cell_edge_m, m.neighborhood, m.neighborhood);
  if (options.settings.area)
    fmt::print("Far maps: {} of {} cells; {}\n", m.cells_with_far_map, m.columns * m.rows,
               m.has_rough_surface ? "they serve bounds, and rays march over the pixels of all cells"
                                   : "receivers in cells without one are traced against the whole city");
  if (result.chosen) print_choice(*result.chosen, options);
  print_end(result, options, seconds);
}

/// Shows one progress line for each stage.
class StageProgress {
 public:
  StageProgress(Verbosity verbosity, ToldDoubts& told) : verbosity_(verbosity), told_(told) {}
  void update(const Progress& progress) {
    if (progress.stage != stage_ || !line_) {
      line_.reset();
      stage_ = progress.stage;
      line_ = std::make_unique<ProgressLine>(stage_, verbosity_);
    }
    line_->update(progress.done, progress.all);
  }
  void show(const PackEstimate& estimate, const Report& report) {
    line_.reset();
    if (verbosity_ == Verbosity::normal) {
      print_doubts(stdout, report, told_);
      fmt::print("{}\n", estimate_text(estimate));
    }
    std::fflush(stdout);
  }

 private:
  Verbosity verbosity_;
  ToldDoubts& told_;
  std::string stage_;
  std::unique_ptr<ProgressLine> line_;
};

PackResult pack_as_told(const PackOptions& options, Report& report, ToldDoubts& told) {
  StageProgress progress(options.run.verbosity, told);
  RunSettings run;
  run.stop = Interruption::token();
  run.threads = thread_count(options.run);
  run.memory_limit_mib = options.memory_limit_mib;
  run.on_progress = [&progress](const Progress& p) {
    // What the stage before has freed goes back to the system, however small its pieces were
    if (p.done == 0) malloc_trim(0);
    progress.update(p);
  };
  try {
    return pack(options.settings, report, run, [&](const PackEstimate& e) { progress.show(e, report); });
  } catch (const ProblemsRefused& refused) {
    throw refusal(refused, options.report_file);
  }
}

void require_outputs(const PackOptions& options) {
  const PackSettings& s = options.settings;
  std::vector<NamedFile> inputs;
  const auto add = [&inputs](const char* option, const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) inputs.push_back({option, file});
  };
  add("INPUT", s.inputs);
  add("--terrain", s.terrain);
  add("--far-terrain", s.far_terrains);
  add("--trees", s.trees.files);
  const std::array<NamedOutput, 2> outputs{{{{"--report", options.report_file}}, {{"--summary", options.run.summary_file}}}};
  require_writable(outputs, {inputs, s.output});
}

int run(const PackOptions& options) {
  // The process is the program's: as many threads as are asked for, also where there are fewer cores
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, thread_count(options.run));
  require_outputs(options);
  const auto start = std::chrono::steady_clock::now();
  Report report;
  ToldDoubts told;
  std::optional<PackResult> result;
  try {
    result = pack_as_told(options, report, told);
  } catch (const std::exception& error) {
    write_report(report, options.report_file);  // what was wrong is wanted most when nothing came of it
    print_doubts(stderr, report, told, error.what());
    throw;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_report(report, options.report_file);
  write_text(options.run.summary_file, pack_summary_json(*result, report, seconds, options.run.settings_json));
  if (options.run.verbosity == Verbosity::normal) print_result(*result, report, options, told, seconds);
  return exit_done;
}

}  // namespace

}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  const Interruption interruption;
  // What one stage frees in large pieces goes back to the system: left to itself, the threshold grows, and keeps them
  // No other thread runs yet. NOLINTNEXTLINE(concurrency-mt-unsafe)
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  return run_program({.name = "farlod-pack",
                      .when_interrupted = "What is finished is kept: the same command goes on with it.",
                      .when_out_of_memory = "Pack the city in parts, or with larger cells."},
                     [&] {
                       const ParsedPackOptions parsed = parse_pack_options(argc, argv);
                       return parsed.options ? run(*parsed.options) : parsed.exit_code;
                     });
}
