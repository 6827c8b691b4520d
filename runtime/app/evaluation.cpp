// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/evaluation.hpp"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "app/memory_limit.hpp"
#include "package/package_error.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Statistics of the sky view factors of some cells. Sums are added cell by cell, in order, so that the mean does not depend on
/// the number of threads.
struct SvfStatistics {
  std::size_t count = 0;
  double sum = 0.0;
  float min = 1.0F, max = 0.0F;
  double width_sum = 0.0;
  float width_max = 0.0F;

  void add(const SvfStatistics& o) {
    *this = {count + o.count,         sum + o.sum,
             std::min(min, o.min),    std::max(max, o.max),
             width_sum + o.width_sum, std::max(width_max, o.width_max)};
  }
};

SvfStatistics statistics_of(const SvfValues& values) {
  SvfStatistics statistics{values.svf.size()};
  for (const float svf : values.svf) {
    statistics.sum += svf;
    statistics.min = std::min(statistics.min, svf);
    statistics.max = std::max(statistics.max, svf);
  }
  for (std::size_t n = 0; n < values.low.size(); ++n) {
    const float width = values.high[n] - values.low[n];
    statistics.width_sum += width;
    statistics.width_max = std::max(statistics.width_max, width);
  }
  return statistics;
}

void store_statistics(const SvfStatistics& all, bool bounds, SvfRun& run) {
  run.receivers = all.count;
  if (all.count == 0) return;
  run.svf_min = all.min;
  run.svf_max = all.max;
  run.svf_mean = all.sum / static_cast<double>(all.count);
  if (bounds) run.bounds = {all.width_sum / static_cast<double>(all.count), all.width_max};
}

/// A cell that is being evaluated, or waits for its turn to be stored.
struct CellInFlight {
  std::size_t n = 0;
  CellReceivers receivers;
  SvfValues values{0, false};
};

/// Evaluates cells on all cores, and stores them one at a time, in their order.
void evaluate_in_order(const SvfOptions& options, std::size_t cell_count,
                       const std::function<CellInFlight(std::size_t)>& evaluate,
                       const std::function<void(const CellInFlight&)>& store) {
  using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
  using Shared = std::shared_ptr<const CellInFlight>;
  std::size_t next = 0;
  const auto hand_out = [&](oneapi::tbb::flow_control& flow) {
    if (next == cell_count) flow.stop();
    return next++;
  };
  oneapi::tbb::parallel_pipeline(
      cells_in_flight(options.run),
      make_filter<void, std::size_t>(filter_mode::serial_in_order, hand_out) &
          make_filter<std::size_t, Shared>(filter_mode::parallel,
                                           [&](std::size_t n) { return std::make_shared<const CellInFlight>(evaluate(n)); }) &
          make_filter<Shared, void>(filter_mode::serial_in_order, [&](const Shared& cell) { store(*cell); }));
}

void require_bounds_known(const Package& package, const SvfOptions& options) {
  const bool asks = options.bounds || options.sky.max_far_error;
  if (!asks || options.sky.engine == Engine::exact || !package.manifest().far_map.is_box()) return;
  throw PackageUnusable(
      options.package.string() +
      " has far maps of the kind box, which know neither bounds nor errors: pack the city with --far-map horizon, "
      "or use --engine exact.");
}

/// Counts and statistics of the cells that were stored so far.
struct Tally {
  std::vector<std::size_t> counts;  ///< receivers of each cell
  SvfStatistics statistics;
  std::size_t outside_of_grid = 0;
  double store_s = 0.0;

  void add(const Package& package, const CellInFlight& cell) {
    counts.push_back(cell.receivers.receivers.size());
    statistics.add(statistics_of(cell.values));
    if (!package.grid().cells.contains(cell.receivers.cell)) outside_of_grid += counts.back();
  }
};

/// Divides the wall clock among the parts of the work in proportion to the thread time of each.
void store_seconds(double wall_s, const EvaluationStatistics& evaluation, double store_s, RunSeconds& seconds) {
  const double busy_s = evaluation.scenes_s + evaluation.evaluate_s + store_s;
  const double scene_share = busy_s > 0.0 ? evaluation.scenes_s / busy_s : 0.0;
  const double store_share = busy_s > 0.0 ? store_s / busy_s : 0.0;
  seconds.scenes = wall_s * scene_share;
  seconds.write = wall_s * store_share;
  seconds.evaluate = wall_s * (1.0 - scene_share - store_share);
}

Tally evaluate_and_store(const SkyEvaluator& evaluator, const SvfOptions& options, std::size_t cell_count,
                         const ReceiversOfCell& receivers_of, const StoreValues& store) {
  Tally tally;
  Progress progress("sky view factors", options.run.verbosity);
  const auto evaluate_cell = [&](std::size_t n) {
    CellReceivers receivers = receivers_of(n);
    SvfValues values = values_of(evaluator, receivers, options.bounds);
    return CellInFlight{n, std::move(receivers), std::move(values)};
  };
  evaluate_in_order(options, cell_count, evaluate_cell, [&](const CellInFlight& cell) {
    const auto start = Clock::now();
    tally.add(evaluator.package(), cell);
    store(cell.n, cell.receivers, cell.values);
    tally.store_s += seconds_since(start);
    progress.update(tally.counts.size(), cell_count);
  });
  return tally;
}

}  // namespace

void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, const StoreValues& store, SvfRun& run) {
  require_bounds_known(package, options);
  const SkyEvaluator evaluator(package, options.sky);
  const auto start = Clock::now();
  const Tally tally = evaluate_and_store(evaluator, options, cell_count, receivers_of, store);
  const EvaluationStatistics evaluation = evaluator.statistics();
  store_seconds(seconds_since(start), evaluation, tally.store_s, run.seconds);
  run.outside_of_grid = tally.outside_of_grid;
  run.by_rays = evaluation.by_rays;
  run.retraced_rays = evaluation.retraced_rays;
  store_statistics(tally.statistics, options.bounds, run);
  if (options.verify_count > 0)
    run.errors = verify(evaluator, {options.verify_count, options.bounds}, tally.counts, receivers_of);
}

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

AnswerColumns answer_columns(const SvfOptions& options) {
  return {quantity_name(options.sky.weight), options.bounds ? BoundsColumns::yes : BoundsColumns::no};
}

}  // namespace farlod
