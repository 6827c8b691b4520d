// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/ordered_run.hpp"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/shard_parts.hpp"
#include "evaluate/quantity_table.hpp"
#include "evaluate/verification.hpp"
#include "farlod/error.hpp"
#include "run/kept_answers.hpp"
#include "run/memory_limit.hpp"
#include "run/svf_statistics.hpp"
#include "scene/seen_building.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A cell that is being evaluated, or waits for its turn to be stored.
struct CellInFlight {
  std::size_t n = 0;
  CellReceivers receivers;
  SvfValues values{0, false};
};

/// Evaluates cells on all threads, and stores them one at a time, in their order.
template <class Evaluate, class Store>
void evaluate_in_order(const ResolvedSettings& settings, std::size_t cell_count, const Evaluate& evaluate, const Store& store) {
  using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
  // Cells are stored in their order, so that those in flight follow each other, and each has a place of its own. What the
  // pipeline itself held when a run is cancelled, oneTBB would lose
  std::vector<CellInFlight> in_flight(cells_in_flight(settings.threads));
  std::size_t next = 0;
  const auto hand_out = [&](oneapi::tbb::flow_control& flow) {
    throw_if_cancelled(settings.run.stop);
    if (next == cell_count) flow.stop();
    return next++;
  };
  oneapi::tbb::parallel_pipeline(
      in_flight.size(), make_filter<void, std::size_t>(filter_mode::serial_in_order, hand_out) &
                            make_filter<std::size_t, CellInFlight*>(filter_mode::parallel,
                                                                    [&](std::size_t n) {
                                                                      CellInFlight& cell = in_flight[n % in_flight.size()];
                                                                      cell = evaluate(n);
                                                                      return &cell;
                                                                    }) &
                            make_filter<CellInFlight*, void>(filter_mode::serial_in_order, [&](CellInFlight* cell) {
                              store(*cell);
                              *cell = {};
                            }));
}

void require_bounds_known(const PackageInUse& package, const ResolvedSettings& settings) {
  const bool asks = settings.bounds || settings.sky.allowed_error;
  if (!asks || settings.sky.engine == Engine::exact || !package.reader().manifest().far_map.is_box()) return;
  throw PackageUnusable(
      package.folder().string() +
      " has far maps of the kind box, which know neither bounds nor errors: pack the city with far maps of the kind horizon "
      "(farlod-pack --far-map horizon), or use the engine exact.");
}

/// Counts and statistics of the cells that were stored so far.
struct Tally {
  std::vector<std::size_t> counts;  ///< receivers of each cell
  SvfStatistics statistics, near_buildings;
  std::vector<SvfStatistics> further_statistics;
  SvfDistribution distribution;
  std::size_t outside_of_grid = 0, without_far_map = 0, outside_of_region = 0;
  RayCounts rays;
  double store_s = 0.0;

  void add(const PackageReader& package, const Quantities& further, const CellInFlight& cell) {
    counts.push_back(cell.receivers.receivers.size());
    statistics.add(statistics_of(cell.receivers, cell.values));
    near_buildings.add(statistics_near_buildings(cell.receivers, cell.values));
    distribution.add(cell.values.svf, cell.receivers.areas_m2);
    const std::vector<SvfStatistics> of_further = further_statistics_of(cell.receivers, cell.values, further);
    further_statistics.resize(of_further.size());
    for (std::size_t k = 0; k < of_further.size(); ++k) further_statistics[k].add(of_further[k]);
    outside_of_region += cell.receivers.outside_of_region;
    rays.by_rays += cell.values.counts.by_rays;
    rays.retraced_rays += cell.values.counts.retraced_rays;
    if (!package.grid().cells.contains(cell.receivers.cell)) outside_of_grid += counts.back();
    if (far_map_of(package, cell.receivers.cell) == FarMapOfCell::missing) without_far_map += counts.back();
  }
  void store(const ResolvedSettings& settings, EvaluationSummary& summary) const {
    store_statistics(statistics, distribution, settings.bounds, summary);
    store_statistics_near_buildings(near_buildings, summary);
    store_further_statistics(further_statistics, settings.sky.further, summary);
    summary.by_rays = rays.by_rays;
    summary.retraced_rays = rays.retraced_rays;
  }
};

/// Divides the wall clock among the parts of the work in proportion to the thread time of each.
EvaluationSeconds seconds_of(double wall_s, const EvaluationStatistics& evaluation, double store_s) {
  const double busy_s = evaluation.scenes_s + evaluation.evaluate_s + store_s;
  const double scene_share = busy_s > 0.0 ? evaluation.scenes_s / busy_s : 0.0;
  const double store_share = busy_s > 0.0 ? store_s / busy_s : 0.0;
  return {wall_s * scene_share, wall_s * (1.0 - scene_share - store_share), wall_s * store_share};
}

/// The error of what answered: of far maps of the kind `box`, and where far maps are missing, that is rays, whatever the engine;
/// beyond the grid, too, unless all is near.
double sampling_error_of_run(const SkySettings& sky, const PackageReader& package, const Tally& tally) {
  double error = sampling_error_of(sky, package.manifest().far_map.is_box() ? FarMapOfCell::box : FarMapOfCell::horizon);
  if (tally.outside_of_grid > 0) error = std::max(error, sampling_error_of(sky, far_map_outside_of_grid(package)));
  if (tally.without_far_map > 0) error = std::max(error, sampling_error_of(sky, FarMapOfCell::missing));
  return error;
}

/// The answers of the n-th cell: as they were kept, or computed now, and kept where that is asked for.
SvfValues answers_of(const SkyEvaluator& evaluator, const ResolvedSettings& settings, std::size_t n, const CellReceivers& cell) {
  const AnswerFile* const file = settings.run.answers.get();
  if (file == nullptr) return values_of(evaluator, cell, settings.bounds);
  auto found = find_answers(*file, n, SvfValues(cell.receivers.size(), settings.bounds, evaluator.further_columns()));
  if (found) return std::move(*found);
  if (file->is_read_only())
    throw OutputError("The answers of cell " + std::to_string(cell.cell.i) + "," + std::to_string(cell.cell.j) +
                      " are missing or damaged: run the shards again.");
  SvfValues values = values_of(evaluator, cell, settings.bounds);
  keep_answers(*file, n, values);
  return values;
}

/// Evaluates the cells whose numbers `number_of(k)` gives, k below `count`, and tells `store` of each, in this order.
template <class NumberOf, class Store>
Tally evaluate_some(const SkyEvaluator& evaluator, const ResolvedSettings& settings, CellsOfRun& cells, std::size_t count,
                    const NumberOf& number_of, const Store& store) {
  Tally tally;
  const auto evaluate_cell = [&](std::size_t k) {
    const std::size_t n = number_of(k);
    CellReceivers receivers = cells.receivers(n);
    SvfValues values = answers_of(evaluator, settings, n, receivers);
    return CellInFlight{n, std::move(receivers), std::move(values)};
  };
  evaluate_in_order(settings, count, evaluate_cell, [&](const CellInFlight& cell) {
    const auto start = Clock::now();
    tally.add(evaluator.package(), settings.sky.further, cell);
    store(cell);
    tally.store_s += seconds_since(start);
    if (settings.run.on_progress) settings.run.on_progress({"sky view factors", tally.counts.size(), count});
  });
  return tally;
}

void forget(const CellInFlight&) {}

/// What a cell costs: the more of the city is in its block, the more is drawn at each receiver.
double cost_of(const PackageReader& package, const CellsOfRun& cells, std::size_t n) {
  constexpr double bytes_that_double = 20'000.0;  // of the tile of a cell, about: one of a dense street costs twice a meadow
  const Grid& grid = package.grid();
  const Cell cell = cells.place(n);
  double bytes = 0.0;
  if (grid.cells.contains(cell)) {
    const package::BlockFiles& block = package.files_of(cell);
    bytes = static_cast<double>(block.tiles.bytes) / static_cast<double>(grid.cells_of(block.block).size());
  }
  return (1.0 + cells.receivers_about(n)) * (1.0 + bytes / bytes_that_double);
}

/// The cells of a shard, and nothing but their answers.
EvaluationSummary keep_shard(const PackageReader& package, const ResolvedSettings& settings, CellsOfRun& cells) {
  std::vector<double> costs;
  for (std::size_t n = 0; n < cells.size(); ++n) costs.push_back(cost_of(package, cells, n));
  const std::vector<std::size_t> mine = parts_of_shard(costs, *settings.run.shard);
  const SkyEvaluator evaluator(package, settings.sky, settings.run.stop);
  const auto start = Clock::now();
  const Tally tally = evaluate_some(
      evaluator, settings, cells, mine.size(), [&](std::size_t k) { return mine[k]; }, forget);
  EvaluationSummary summary;
  summary.seconds = seconds_of(seconds_since(start), evaluator.statistics(), 0.0);
  summary.accuracy = settings.accuracy;
  tally.store(settings, summary);
  return summary;
}

EvaluationSummary evaluate_and_verify(const PackageReader& package, const ResolvedSettings& settings, CellsOfRun& cells) {
  const SkyEvaluator evaluator(package, settings.sky, settings.run.stop);
  const auto start = Clock::now();
  const Tally tally = evaluate_some(
      evaluator, settings, cells, cells.size(), [](std::size_t k) { return k; },
      [&](const CellInFlight& cell) { cells.store(cell.n, cell.receivers, cell.values); });
  const EvaluationStatistics evaluation = evaluator.statistics();
  EvaluationSummary summary;
  summary.seconds = seconds_of(seconds_since(start), evaluation, tally.store_s);
  summary.accuracy = settings.accuracy;
  summary.accuracy.sampling_error = sampling_error_of_run(settings.sky, package, tally);
  summary.outside_of_region = tally.outside_of_region;
  summary.outside_of_grid = tally.outside_of_grid;
  summary.without_far_map = tally.without_far_map;
  tally.store(settings, summary);
  if (settings.verify > 0) {
    Verification found = verify(evaluator, {settings.verify, settings.bounds}, tally.counts, cells);
    summary.errors = found.errors;
    summary.svf_total_errors = found.svf_total_errors;
    summary.verified = std::move(found.receivers);
  }
  return summary;
}

/// The seconds that some cells took, by what they have to make first.
struct SampledSeconds {
  std::vector<double> first_of_group;  ///< which reads its block, and the first of all what is made once for the city
  double others = 0.0;
  std::size_t other_cells = 0;

  [[nodiscard]] double of_run(double cells, double blocks) const {
    if (first_of_group.empty()) return 0.0;
    const auto mean = [](std::span<const double> s) {
      return std::accumulate(s.begin(), s.end(), 0.0) / static_cast<double>(s.size());
    };
    const double first = mean(first_of_group.size() > 1 ? std::span(first_of_group).subspan(1) : std::span(first_of_group));
    const double cell = other_cells > 0 ? others / static_cast<double>(other_cells) : first;
    return std::max(0.0, first_of_group.front() - first) + cells * cell + blocks * std::max(0.0, first - cell);
  }
};

/// Cells of which a share of the receivers is evaluated, in two runs of neighbors: those share what costs most.
class ThinnedCells : public CellsOfRun {
 public:
  /// Keeps one of `thinning` receivers.
  ThinnedCells(CellsOfRun& cells, std::size_t thinning) : cells_(cells), thinning_(thinning) {}

  [[nodiscard]] std::size_t size() const override { return cells_.size(); }
  [[nodiscard]] Cell place(std::size_t n) const override { return cells_.place(n); }
  [[nodiscard]] double receivers_about(std::size_t n) const override { return cells_.receivers_about(n); }
  [[nodiscard]] CellReceivers receivers(std::size_t n) override {
    CellReceivers cell = cells_.receivers(n);
    const std::size_t together = cell.receivers.size() / (2 * thinning_) + 1;
    all_ += cell.receivers.size();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < cell.receivers.size(); ++k)
      if (k / together % thinning_ == 0) cell.receivers[kept++] = cell.receivers[k];
    cell.receivers.resize(kept);
    cell.is_near_building.clear();  // nobody is told a mean
    cell.areas_m2.clear();
    kept_ += kept;
    return cell;
  }
  void store(std::size_t, const CellReceivers&, const SvfValues&) override {}

  /// How many receivers stand behind one that was kept.
  [[nodiscard]] double per_kept() const {
    return kept_ == 0 ? 1.0 : static_cast<double>(all_.load()) / static_cast<double>(kept_.load());
  }

 private:
  CellsOfRun& cells_;
  std::size_t thinning_;
  std::atomic<std::size_t> all_ = 0, kept_ = 0;  // several threads ask for receivers
};

/// Evaluates cells of a dry run, and tells how long it would take with all of their receivers.
class SampledCells {
 public:
  SampledCells(const PackageReader& package, const ResolvedSettings& settings, CellsOfRun& cells_of_run, std::size_t thinning)
      : evaluator_(package, settings.sky, settings.run.stop),
        settings_(settings),
        cells_of_run_(cells_of_run),
        thinning_(thinning) {
    settings_.run.answers = nullptr;
  }

  double evaluate(std::size_t first, std::size_t end) {
    ThinnedCells thinned(cells_of_run_, thinning_);
    const EvaluationStatistics before = evaluator_.statistics();
    const auto start = Clock::now();
    const Tally tally = evaluate_some(
        evaluator_, settings_, thinned, end - first, [&](std::size_t k) { return first + k; }, forget);
    const double taken_s = seconds_since(start);
    const EvaluationStatistics after = evaluator_.statistics();
    evaluated_ += tally.statistics.count;
    receivers_ += thinned.per_kept() * static_cast<double>(tally.statistics.count);
    cells_ += end - first;
    // A scene is made for all receivers of a cell
    const EvaluationSeconds parts =
        seconds_of(taken_s, {{}, after.scenes_s - before.scenes_s, after.evaluate_s - before.evaluate_s}, 0.0);
    return taken_s + (thinned.per_kept() - 1.0) * parts.evaluate;
  }
  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::size_t receivers() const { return evaluated_; }
  [[nodiscard]] double receivers_per_cell() const { return cells_ == 0 ? 0.0 : receivers_ / static_cast<double>(cells_); }

 private:
  SkyEvaluator evaluator_;
  ResolvedSettings settings_;
  CellsOfRun& cells_of_run_;
  std::size_t thinning_, cells_ = 0, evaluated_ = 0;
  double receivers_ = 0.0;
};

/// From groups of cells that follow each other, as they do in a run, spread over all. Where they are more than an eighth of all
/// cells, some of their receivers are evaluated.
EvaluationSummary estimate(const PackageReader& package, const ResolvedSettings& settings, CellsOfRun& cells_of_run) {
  constexpr std::size_t most_groups = 8, cells_in_group = 6, least_saving = 8;
  const std::size_t cell_count = cells_of_run.size(), groups = std::min(cell_count, most_groups);
  const std::size_t sampled = std::min(cell_count, most_groups * cells_in_group);
  SampledCells sample(package, settings, cells_of_run,
                      cell_count == 0 ? 1 : (least_saving * sampled + cell_count - 1) / cell_count);
  SampledSeconds seconds;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t begin = g * cell_count / groups, end = (g + 1) * cell_count / groups;
    const std::size_t size = std::min(cells_in_group, end - begin), first = begin + (end - begin - size) / 2;
    seconds.first_of_group.push_back(sample.evaluate(first, first + 1));
    seconds.others += sample.evaluate(first + 1, first + size);
    seconds.other_cells += size - 1;
  }
  const double cells = static_cast<double>(cell_count), edge = static_cast<double>(package.grid().block_edge);
  EvaluationSummary summary;
  summary.accuracy = settings.accuracy;
  summary.estimate = {cell_count,
                      sample.cells(),
                      sample.receivers(),
                      cells * sample.receivers_per_cell(),
                      seconds.of_run(cells, std::ceil(cells / (edge * edge))),
                      0.0};
  return summary;
}

}  // namespace

EvaluationSummary evaluate_cells(const PackageInUse& package, const ResolvedSettings& settings, CellsOfRun& cells) {
  require_bounds_known(package, settings);
  // Before the work: a wrong id is told at once
  if (settings.sky.further.seen_building) require_building(package.reader(), *settings.sky.further.seen_building);
  // Threads of this run alone: another run of the process may have another number of threads
  oneapi::tbb::task_arena arena(static_cast<int>(settings.threads));
  return arena.execute([&] {
    if (settings.dry_run) return estimate(package.reader(), settings, cells);
    if (settings.run.shard) return keep_shard(package.reader(), settings, cells);
    return evaluate_and_verify(package.reader(), settings, cells);
  });
}

}  // namespace farlod
