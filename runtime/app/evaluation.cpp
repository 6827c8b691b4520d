// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/evaluation.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "package/package_error.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Figures over the answers of some cells. Sums are taken cell by cell, in order, so that threads do not change the mean.
struct CellFigures {
  std::size_t count = 0;
  double sum = 0.0;
  float min = 1.0F, max = 0.0F;
  double width_sum = 0.0;
  float width_max = 0.0F;
};

CellFigures figures_of(const CellReceivers& cell, const AnswerTable& answers) {
  CellFigures figures{cell.receivers.size()};
  for (const Receiver& r : cell.receivers) {
    figures.sum += answers.svf[r.index];
    figures.min = std::min(figures.min, answers.svf[r.index]);
    figures.max = std::max(figures.max, answers.svf[r.index]);
    if (answers.low.empty()) continue;
    const float width = answers.high[r.index] - answers.low[r.index];
    figures.width_sum += width;
    figures.width_max = std::max(figures.width_max, width);
  }
  return figures;
}

void add_figures(std::span<const CellFigures> cells, bool bounds, SvfRun& run) {
  CellFigures all;
  for (const CellFigures& c : cells) {
    if (c.count == 0) continue;
    all = {all.count + c.count,         all.sum + c.sum,
           std::min(all.min, c.min),    std::max(all.max, c.max),
           all.width_sum + c.width_sum, std::max(all.width_max, c.width_max)};
  }
  run.receivers = all.count;
  if (all.count == 0) return;
  run.svf_min = all.min;
  run.svf_max = all.max;
  run.svf_mean = all.sum / static_cast<double>(all.count);
  if (bounds) run.bounds = {all.width_sum / static_cast<double>(all.count), all.width_max};
}

/// Random receivers among all that have an answer: which of each cell's.
std::vector<std::vector<std::size_t>> choose_receivers(std::span<const CellFigures> cells, std::size_t wanted) {
  std::size_t all = 0;
  for (const CellFigures& c : cells) all += c.count;
  std::vector<std::vector<std::size_t>> chosen(cells.size());
  std::size_t cell = 0, first = 0;
  for (const std::size_t n : choose_some(all, wanted)) {
    while (n >= first + cells[cell].count) first += cells[cell++].count;
    chosen[cell].push_back(n - first);
  }
  return chosen;
}

ErrorSummary verify(const Package& package, const SvfOptions& options, std::span<const CellFigures> cells,
                    const ReceiversOfCell& receivers_of, std::span<const float> svf) {
  const SkyEvaluator reference(package,
                               {Engine::exact, options.sky.weight, std::max(verify_rays, options.sky.rays), std::nullopt});
  const auto chosen = choose_receivers(cells, options.verify_count);
  std::vector<std::vector<double>> answers(cells.size()), exact(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    if (chosen[n].empty()) return;
    const CellReceivers all = receivers_of(n);
    CellReceivers some{all.cell, {}};
    for (const std::size_t k : chosen[n]) {
      some.receivers.push_back(all.receivers[k]);
      some.receivers.back().index = some.receivers.size() - 1;
      answers[n].push_back(svf[all.receivers[k].index]);
    }
    std::vector<float> exact_svf(some.receivers.size());
    reference.evaluate(some, exact_svf);
    exact[n].assign(exact_svf.begin(), exact_svf.end());
  });
  std::vector<double> all_answers, all_exact;
  for (std::size_t n = 0; n < cells.size(); ++n) {
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

}  // namespace

void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, AnswerTable& answers, SvfRun& run) {
  require_bounds_known(package, options);
  const SkyEvaluator evaluator(package, options.sky);
  std::vector<CellFigures> figures(cell_count);
  std::atomic<std::size_t> cells_done = 0, outside = 0;
  const auto start = Clock::now();
  {
    Progress progress("sky view factors", options.run.verbosity);
    oneapi::tbb::parallel_for(std::size_t{0}, cell_count, [&](std::size_t n) {
      const CellReceivers receivers = receivers_of(n);
      evaluator.evaluate(receivers, SkyAnswers(answers.svf, answers.low, answers.high));
      figures[n] = figures_of(receivers, answers);
      if (!package.grid().cells.contains(receivers.cell)) outside += receivers.receivers.size();
      progress.update(++cells_done, cell_count);
    });
  }
  // Threads share the wall clock in proportion to what each part took of them
  const double wall_s = seconds_since(start);
  const SkyEvaluator::Effort effort = evaluator.effort();
  const double busy_s = effort.scenes_s + effort.rays_s;
  const double scene_share = busy_s > 0.0 ? effort.scenes_s / busy_s : 0.0;
  run.seconds.scenes += wall_s * scene_share;
  run.seconds.evaluate += wall_s * (1.0 - scene_share);
  run.outside_of_grid = outside;
  run.settled_rays = effort.settled_rays;
  add_figures(figures, options.bounds, run);
  if (options.verify_count > 0) run.errors = verify(package, options, figures, receivers_of, answers.svf);
}

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

}  // namespace farlod
