// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/evaluation.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <utility>

#include "app/memory_limit.hpp"
#include "package/package_error.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Figures over the answers of some cells. Sums are taken cell by cell, in order, so that threads do not change the mean.
struct Figures {
  std::size_t count = 0;
  double sum = 0.0;
  float min = 1.0F, max = 0.0F;
  double width_sum = 0.0;
  float width_max = 0.0F;

  void add(const Figures& o) {
    *this = {count + o.count,         sum + o.sum,
             std::min(min, o.min),    std::max(max, o.max),
             width_sum + o.width_sum, std::max(width_max, o.width_max)};
  }
};

Figures figures_of(const AnswerTable& answers) {
  Figures figures{answers.svf.size()};
  for (const float svf : answers.svf) {
    figures.sum += svf;
    figures.min = std::min(figures.min, svf);
    figures.max = std::max(figures.max, svf);
  }
  for (std::size_t n = 0; n < answers.low.size(); ++n) {
    const float width = answers.high[n] - answers.low[n];
    figures.width_sum += width;
    figures.width_max = std::max(figures.width_max, width);
  }
  return figures;
}

void store_figures(const Figures& all, bool bounds, SvfRun& run) {
  run.receivers = all.count;
  if (all.count == 0) return;
  run.svf_min = all.min;
  run.svf_max = all.max;
  run.svf_mean = all.sum / static_cast<double>(all.count);
  if (bounds) run.bounds = {all.width_sum / static_cast<double>(all.count), all.width_max};
}

/// A cell on its way: handed out, evaluated, taken.
struct CellInFlight {
  std::size_t n = 0;
  CellReceivers receivers;
  AnswerTable answers{0, false};
};

AnswerTable answers_of(const SkyEvaluator& evaluator, CellReceivers cell, bool bounds) {
  AnswerTable answers(cell.receivers.size(), bounds);
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) cell.receivers[k].index = k;
  evaluator.evaluate(cell, SkyAnswers(answers.svf, answers.low, answers.high));
  return answers;
}

/// Evaluates cells on all cores; they are taken one at a time, in their order.
void evaluate_in_order(const SvfOptions& options, std::size_t cell_count,
                       const std::function<CellInFlight(std::size_t)>& evaluate,
                       const std::function<void(const CellInFlight&)>& take) {
  using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
  using OnItsWay = std::shared_ptr<const CellInFlight>;
  std::size_t next = 0;
  const auto hand_out = [&](oneapi::tbb::flow_control& flow) {
    if (next == cell_count) flow.stop();
    return next++;
  };
  oneapi::tbb::parallel_pipeline(
      cells_in_flight(options.run),
      make_filter<void, std::size_t>(filter_mode::serial_in_order, hand_out) &
          make_filter<std::size_t, OnItsWay>(filter_mode::parallel,
                                             [&](std::size_t n) { return std::make_shared<const CellInFlight>(evaluate(n)); }) &
          make_filter<OnItsWay, void>(filter_mode::serial_in_order, [&](const OnItsWay& cell) { take(*cell); }));
}

/// Random receivers among all that have an answer: which of each cell's.
std::vector<std::vector<std::size_t>> choose_receivers(std::span<const std::size_t> counts, std::size_t wanted) {
  std::vector<std::vector<std::size_t>> chosen(counts.size());
  std::size_t cell = 0, first = 0;
  for (const std::size_t n : choose_some(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), wanted)) {
    while (n >= first + counts[cell]) first += counts[cell++];
    chosen[cell].push_back(n - first);
  }
  return chosen;
}

SkySettings reference_settings(SkySettings settings) {
  settings.engine = Engine::exact;
  settings.rays = std::max(verify_rays, settings.rays);
  settings.max_far_error.reset();
  return settings;
}

/// Answers are not kept: those of the cells of the chosen are computed once more, all together as they were, beside the exact
/// ones.
ErrorSummary verify(const Package& package, const SvfOptions& options, const SkyEvaluator& evaluator,
                    std::span<const std::size_t> counts, const ReceiversOfCell& receivers_of) {
  const SkyEvaluator reference(package, reference_settings(options.sky));
  const auto chosen = choose_receivers(counts, options.verify_count);
  std::vector<std::vector<float>> answers(counts.size()), exact(counts.size());
  oneapi::tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t n) {
    if (chosen[n].empty()) return;
    const CellReceivers all = receivers_of(n);
    CellReceivers some{all.cell, {}};
    for (const std::size_t k : chosen[n]) some.receivers.push_back(all.receivers[k]);
    const std::vector<float> answers_of_all = answers_of(evaluator, all, options.bounds).svf;
    for (const std::size_t k : chosen[n]) answers[n].push_back(answers_of_all[k]);
    exact[n] = answers_of(reference, some, false).svf;
  });
  std::vector<double> all_answers, all_exact;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    all_answers.insert(all_answers.end(), answers[n].begin(), answers[n].end());
    all_exact.insert(all_exact.end(), exact[n].begin(), exact[n].end());
  }
  return summarize_errors(all_answers, all_exact);
}

void require_bounds_known(const Package& package, const SvfOptions& options) {
  const bool asks = options.bounds || options.sky.max_far_error;
  if (!asks || options.sky.engine == Engine::exact || !package.manifest().far_map.is_box()) return;
  throw PackageUnusable(
      options.package.string() +
      " has far maps of the kind box, which know neither bounds nor errors: pack the city with --far-map horizon, "
      "or use --engine exact.");
}

/// What is summed up while cells are taken.
struct Tally {
  std::vector<std::size_t> counts;  ///< receivers of each cell
  Figures figures;
  std::size_t outside_of_grid = 0;
  double take_s = 0.0;

  void add(const Package& package, const CellInFlight& cell) {
    counts.push_back(cell.receivers.receivers.size());
    figures.add(figures_of(cell.answers));
    if (!package.grid().cells.contains(cell.receivers.cell)) outside_of_grid += counts.back();
  }
};

/// Threads share the wall clock in proportion to what each part took of them.
void store_seconds(double wall_s, const SkyEvaluator::Effort& effort, double take_s, RunSeconds& seconds) {
  const double busy_s = effort.scenes_s + effort.evaluate_s + take_s;
  const double scene_share = busy_s > 0.0 ? effort.scenes_s / busy_s : 0.0;
  const double take_share = busy_s > 0.0 ? take_s / busy_s : 0.0;
  seconds.scenes = wall_s * scene_share;
  seconds.write = wall_s * take_share;
  seconds.evaluate = wall_s * (1.0 - scene_share - take_share);
}

Tally evaluate_and_take(const Package& package, const SvfOptions& options, const SkyEvaluator& evaluator, std::size_t cell_count,
                        const ReceiversOfCell& receivers_of, const TakeAnswers& take) {
  Tally tally;
  Progress progress("sky view factors", options.run.verbosity);
  const auto evaluate_cell = [&](std::size_t n) {
    CellReceivers receivers = receivers_of(n);
    AnswerTable answers = answers_of(evaluator, receivers, options.bounds);
    return CellInFlight{n, std::move(receivers), std::move(answers)};
  };
  evaluate_in_order(options, cell_count, evaluate_cell, [&](const CellInFlight& cell) {
    const auto start = Clock::now();
    tally.add(package, cell);
    take(cell.n, cell.receivers, cell.answers);
    tally.take_s += seconds_since(start);
    progress.update(tally.counts.size(), cell_count);
  });
  return tally;
}

}  // namespace

void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, const TakeAnswers& take, SvfRun& run) {
  require_bounds_known(package, options);
  const SkyEvaluator evaluator(package, options.sky);
  const auto start = Clock::now();
  const Tally tally = evaluate_and_take(package, options, evaluator, cell_count, receivers_of, take);
  store_seconds(seconds_since(start), evaluator.effort(), tally.take_s, run.seconds);
  run.outside_of_grid = tally.outside_of_grid;
  run.by_rays = evaluator.effort().by_rays;
  run.retraced_rays = evaluator.effort().retraced_rays;
  store_figures(tally.figures, options.bounds, run);
  if (options.verify_count > 0) run.errors = verify(package, options, evaluator, tally.counts, receivers_of);
}

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

AnswerColumns answer_columns(const SvfOptions& options) {
  return {quantity_name(options.sky.weight), options.bounds ? BoundsColumns::yes : BoundsColumns::no};
}

}  // namespace farlod
