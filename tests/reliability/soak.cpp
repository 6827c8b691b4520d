// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/counted/held_memory.hpp"

// Asks whether a process that evaluates for hours stays as it is: opens a package once, evaluates all of its cells again and
// again, and fails where an answer changes, or memory, open files or threads become more.

namespace farlod {
namespace {

/// By which the most that the last third of the passes hold at a time may be above that of the second: which threads happen to
/// work at the same time. The larger of the two counts.
constexpr double memory_slack = 0.05, memory_slack_mib = 1.0;
/// By which what is held after the passes of the last third may be above that of the second: caches of threads
constexpr double kept_slack_mib = 1.0;

struct Options {
  std::string package;
  double seconds = 1200.0;
  std::size_t passes = 0;  ///< 0: as many as the seconds allow
  std::uint64_t memory_limit_mib = 512;
  std::size_t threads = 0;
  double step_m = 16.0;
};

/// What the kernel says of this process, and what was asked of malloc.
struct ProcessSample {
  double peak_mib = 0.0;  ///< largest resident memory since the sample before
  double resident_mib = 0.0, anonymous_mib = 0.0, files_mib = 0.0;
  double most_held_mib = 0.0, kept_mib = 0.0;  ///< at a time since the sample before, and now
  std::size_t descriptors = 0, threads = 0;
};

std::size_t entries_of(const char* folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// A line of /proc/self/status.
double status_mib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  double kib = 0.0;
  for (std::string word; status >> word;)
    if (word == key && status >> kib) return kib / 1024.0;
  throw std::runtime_error("/proc/self/status has no " + key);
}

double mib_of(std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

ProcessSample take_sample(std::size_t most_held_bytes) {
  const ProcessSample sample{status_mib("VmHWM:"),        status_mib("VmRSS:"),         status_mib("RssAnon:"),
                             status_mib("RssFile:"),      mib_of(most_held_bytes),      mib_of(HeldMemory::now_bytes()),
                             entries_of("/proc/self/fd"), entries_of("/proc/self/task")};
  // Forgets the peak. Where that is not allowed, the peak is that of all passes, and the comparison is stricter
  std::ofstream("/proc/self/clear_refs") << 5;
  return sample;
}

/// What came of a work: as many answers, of the same bits, in each pass.
class Tally {
 public:
  void add(std::span<const float> values) {
    for (const float value : values) mix(std::bit_cast<std::uint32_t>(value));
  }
  void add(double value) { mix(std::bit_cast<std::uint64_t>(value)); }
  void add(const EvaluationSummary& summary) {
    receivers += summary.receivers;
    for (const std::size_t count : {summary.receivers, summary.no_data, summary.beyond_grid}) mix(count);
  }
  bool operator==(const Tally&) const = default;

  std::uint64_t receivers = 0;

 private:
  /// FNV-1a, by words
  void mix(std::uint64_t word) { bits_ = (std::rotl(bits_, 29) ^ word) * 0x100000001b3; }

  std::uint64_t bits_ = 0xcbf29ce484222325;
};

EvaluationSettings settings_of(Engine engine, bool bounds, Quantities further = {}) {
  EvaluationSettings settings;
  settings.engine = engine;
  settings.bounds = bounds;
  settings.azimuths = 72;
  settings.rays = 100;
  settings.further = std::move(further);
  return settings;
}

/// Calls `use` for the windows that a raster is divided into.
void for_each_window(const RasterPlan& plan, const auto& use) {
  constexpr std::size_t edge = 500;
  for (std::size_t row = 0; row < plan.rows; row += edge)
    for (std::size_t column = 0; column < plan.columns; column += edge)
      use(RasterWindow{column, row, std::min(edge, plan.columns - column), std::min(edge, plan.rows - row)});
}

/// Places within some cells, which look in all directions.
struct Places {
  std::vector<double> x_m, y_m;
  std::vector<Angle> azimuth, tilt;

  void add(const CellContents& cell) {
    constexpr std::array shares{0.1, 0.35, 0.6, 0.9};
    const Point2d corner = cell.corners_projected[0], east = cell.corners_projected[1], north = cell.corners_projected[3];
    for (const double a : shares)
      for (const double b : shares) {
        const Point2d p = corner + a * (east - corner) + b * (north - corner);
        x_m.push_back(p.x), y_m.push_back(p.y);
        azimuth.push_back(Angle::degrees(360.0 * b)), tilt.push_back(Angle::degrees(a < 0.5 ? 0.0 : 90.0 * b));
      }
  }
};

/// A part of each cell: stripes from west to east, the share of the city that is given.
std::shared_ptr<const Region> stripes_of(const PackageDescription& city, double share) {
  const auto [low, high] = city.outline_projected;
  std::vector<Region::Ring> stripes;
  for (double south = low.y; south < high.y; south += city.cell_edge_m) {
    const double north = south + share * city.cell_edge_m;
    stripes.push_back({{low.x, south}, {high.x, south}, {high.x, north}, {low.x, north}});
  }
  return std::make_shared<const Region>(stripes);
}

/// An open package, and the works on it.
class Soak {
 public:
  explicit Soak(const Options& options)
      : package_(options.package),
        plan_(plan_raster(package_, options.step_m)),
        stripes_(stripes_of(package_.description(), 0.25)) {
    run_.memory_limit_mib = options.memory_limit_mib;
    run_.threads = options.threads;
    const CellRectangle cells = inventory_of(package_).cells;
    for (std::int32_t j = cells.j_begin; j < cells.j_end; ++j) {
      Places& row = rows_.emplace_back();
      for (std::int32_t i = cells.i_begin; i < cells.i_end; ++i) row.add(inspect_cell(package_, {i, j}));
    }
  }

  void evaluate_windows(const EvaluationSettings& settings, Tally& tally) const {
    for_each_window(plan_, [&](const RasterWindow& window) {
      const Raster raster = evaluate_window(package_, plan_, window, {}, settings, run_);
      tally.add(raster.svf), tally.add(raster.low), tally.add(raster.high), tally.add(raster.summary);
    });
  }

  void evaluate_tiles(const EvaluationSettings& settings, Tally& tally) const {
    const auto take = [&](const RasterTile& tile) {
      tally.add(tile.svf), tally.add(tile.low), tally.add(tile.high);
      for (const std::vector<float>& band : tile.further) tally.add(band);
    };
    tally.add(evaluate_raster(package_, plan_, {}, settings, take, run_));
  }

  /// A run for each row of cells.
  void evaluate_rows(const EvaluationSettings& settings, Tally& tally) const {
    for (const Places& row : rows_) {
      const Points points{row.x_m, row.y_m, {}, row.azimuth, row.tilt};
      const PointAnswers answers = evaluate_points(package_, points, {}, settings, run_);
      tally.add(answers.svf), tally.add(answers.low), tally.add(answers.high), tally.add(answers.further);
      tally.add(answers.summary);
    }
  }

  template <SurfaceChoice choice>
  void evaluate_all_surfaces(const EvaluationSettings& given, Tally& tally) const {
    constexpr double not_answered = -1.0, spacing_m = 10.0;
    const auto take = [&](std::size_t, std::span<const SurfacePoint> points) {
      for (const SurfacePoint& point : points) {
        for (const auto& value : {point.svf, point.low, point.high}) tally.add(value.value_or(not_answered));
        tally.add(point.further);
      }
    };
    EvaluationSettings settings = given;
    settings.region = stripes_;
    RunSettings run = run_;
    run.memory_limit_mib.reset();
    const SurfaceMeans means = evaluate_surfaces(package_, {choice, spacing_m}, settings, take, run);
    for (const SurfaceMean& surface : means.surfaces) tally.add(surface.area_m2);
    tally.add(means.summary);
  }

 private:
  Package package_;
  RasterPlan plan_;
  RunSettings run_;
  std::vector<Places> rows_;  ///< of cells, from the south
  /// Where surfaces have receivers. The limit of a run counts a row for each surface of the whole city, whatever the region: runs
  /// of surfaces have none, and the process must keep it
  std::shared_ptr<const Region> stripes_;
};

/// One way to evaluate all cells.
struct Work {
  const char* name;
  void (Soak::*evaluate)(const EvaluationSettings&, Tally&) const;
  EvaluationSettings settings;
};

/// Every kind of receivers by every engine, and each further quantity, but for the distances of horizons: they need a scene of
/// the whole city, which a limit of memory refuses.
std::vector<Work> all_works() {
  using enum Engine;
  const auto windows = &Soak::evaluate_windows, tiles = &Soak::evaluate_tiles, points = &Soak::evaluate_rows,
             roofs = &Soak::evaluate_all_surfaces<SurfaceChoice::roofs>,
             walls = &Soak::evaluate_all_surfaces<SurfaceChoice::walls>;
  const Quantities shares{.svf_solid = true, .directional = true, .hidden = true};
  const Quantities patches{.horizons = 36, .sky_patches = SkyPatchSet::tregenza};
  const Quantities sunshine{.sun = {{{Angle::degrees(135.0), Angle::degrees(30.0), 1.0},
                                     {Angle::degrees(180.0), Angle::degrees(50.0), 2.0},
                                     {Angle::degrees(240.0), Angle::degrees(15.0), 1.0}}}};
  return {{"windows, auto", windows, settings_of(automatic, false)},
          {"windows, auto, bounds", windows, settings_of(automatic, true)},
          {"windows, rays", windows, settings_of(rays, false)},
          {"tiles, horizon, bounds", tiles, settings_of(horizon, true)},
          {"tiles, auto, shares", tiles, settings_of(automatic, false, shares)},
          {"tiles, rays, bounds", tiles, settings_of(rays, true)},
          {"points, auto, patches", points, settings_of(automatic, false, patches)},
          {"points, horizon, sunshine", points, settings_of(horizon, false, sunshine)},
          {"points, rays, bounds", points, settings_of(rays, true, shares)},
          {"roofs, auto, bounds", roofs, settings_of(automatic, true)},
          {"roofs, rays, sunshine", roofs, settings_of(rays, false, sunshine)},
          {"walls, horizon", walls, settings_of(horizon, false, shares)},
          {"walls, auto, bounds", walls, settings_of(automatic, true)}};
}

void tell(double seconds, std::size_t passes, std::uint64_t receivers, const ProcessSample& sample) {
  std::printf("%6.0f s: %zu passes, %.1f million receivers; ", seconds, passes, 1e-6 * static_cast<double>(receivers));
  std::printf("resident %.1f MiB (anonymous %.1f, files %.1f), peak %.1f; held %.2f, at most %.2f; %zu open files, %zu threads\n",
              sample.resident_mib, sample.anonymous_mib, sample.files_mib, sample.peak_mib, sample.kept_mib, sample.most_held_mib,
              sample.descriptors, sample.threads);
  std::fflush(stdout);
}

/// The passes of a run over all works.
struct Passes {
  std::vector<ProcessSample> samples;  ///< after each
  std::uint64_t receivers = 0;
  std::vector<std::string> findings;
};

void evaluate_pass(const Soak& soak, const std::vector<Work>& works, std::vector<Tally>& first, Passes& passes) {
  const std::size_t before = HeldMemory::now_bytes();
  const HeldMemory held;
  for (std::size_t n = 0; n < works.size(); ++n) {
    Tally tally;
    try {
      (soak.*works[n].evaluate)(works[n].settings, tally);
    } catch (const Error& error) {
      throw std::runtime_error(std::string(works[n].name) + ": " + error.what());
    }
    passes.receivers += tally.receivers;
    if (passes.samples.empty()) first.push_back(tally);
    if (tally != first[n])
      passes.findings.push_back(std::string(works[n].name) + ": other answers in pass " +
                                std::to_string(passes.samples.size() + 1));
  }
  passes.samples.push_back(take_sample(before + held.most_bytes()));
}

Passes evaluate_for(const Options& options) {
  constexpr double between_lines_s = 60.0;
  const Soak soak(options);
  const std::vector<Work> works = all_works();
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [begin] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  double next_line_s = 0.0;
  std::vector<Tally> first;
  Passes passes;
  const auto is_over = [&] {
    return options.passes > 0 ? passes.samples.size() >= options.passes : seconds() >= options.seconds;
  };
  while (!is_over() || passes.samples.size() < 3) {
    evaluate_pass(soak, works, first, passes);
    const bool is_last = is_over();
    if (seconds() < next_line_s && !is_last) continue;
    tell(seconds(), passes.samples.size(), passes.receivers, passes.samples.back());
    next_line_s += between_lines_s * (1.0 + std::floor((seconds() - next_line_s) / between_lines_s));
  }
  return passes;
}

double largest(std::span<const ProcessSample> samples, double ProcessSample::*figure) {
  return std::ranges::max(samples, {}, figure).*figure;
}

/// The first third of the passes fills what is kept from then on, and is compared with nothing.
void judge_memory(const Passes& passes, const Options& options, std::vector<std::string>& findings) {
  if (!HeldMemory::counts_malloc) return;
  const std::span all(passes.samples);
  const auto second = all.subspan(all.size() / 3, all.size() - 2 * (all.size() / 3)), last = all.last(all.size() / 3);
  const double most_mib[] = {largest(second, &ProcessSample::most_held_mib), largest(last, &ProcessSample::most_held_mib)};
  const double kept_mib[] = {largest(second, &ProcessSample::kept_mib), largest(last, &ProcessSample::kept_mib)};
  std::printf("second third: holds %.2f MiB at most, %.2f after a pass; last third: %.2f, %.2f\n", most_mib[0], kept_mib[0],
              most_mib[1], kept_mib[1]);
  if (most_mib[1] > most_mib[0] + std::max(memory_slack * most_mib[0], memory_slack_mib)) findings.emplace_back("memory grows");
  if (kept_mib[1] > kept_mib[0] + kept_slack_mib) findings.emplace_back("what is kept grows");
  if (largest(all, &ProcessSample::peak_mib) > static_cast<double>(options.memory_limit_mib))
    findings.emplace_back("more memory than the limit");
}

int judge(const Passes& passes, const Options& options) {
  std::vector<std::string> findings = passes.findings;
  judge_memory(passes, options, findings);
  const ProcessSample &before = passes.samples[passes.samples.size() / 3 - 1], &after = passes.samples.back();
  if (before.descriptors != after.descriptors) findings.emplace_back("another number of open files");
  if (before.threads != after.threads) findings.emplace_back("another number of threads");
  for (const std::string& finding : findings) std::printf("FAILED: %s\n", finding.c_str());
  if (findings.empty()) std::printf("The same answers in all passes; memory, open files and threads are flat.\n");
  return findings.empty() ? 0 : 1;
}

}  // namespace
}  // namespace farlod

// Only a mistake in the description of the options is not caught. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("farlod-soak — does a process stay as it is that evaluates all cells again and again?", "farlod-soak");
  farlod::Options options;
  app.add_option("PACKAGE", options.package, "A package with far maps of the kind horizon")->required();
  app.add_option("--seconds", options.seconds, "How long; three passes at least")->capture_default_str();
  app.add_option("--passes", options.passes, "So many passes, whatever the time; 0: as --seconds says")->capture_default_str();
  app.add_option("--memory-limit", options.memory_limit_mib, "MiB, of each run and of the process")->capture_default_str();
  app.add_option("--threads", options.threads, "Of each run; 0: as many as cores")->capture_default_str();
  app.add_option("--step", options.step_m, "Edge of a pixel of the rasters, in metres")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return farlod::judge(farlod::evaluate_for(options), options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-soak: %s\n", error.what());
    return 1;
  }
}
