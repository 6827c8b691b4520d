// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/evaluation.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Figures over the answers of some cells. Sums are taken cell by cell, in order, so that threads do not change the mean.
struct CellFigures {
  std::size_t count = 0;
  double sum = 0.0;
  float min = 1.0F, max = 0.0F;
};

CellFigures figures_of(const CellReceivers& cell, std::span<const float> svf) {
  CellFigures figures{cell.receivers.size()};
  for (const Receiver& r : cell.receivers) {
    figures.sum += svf[r.index];
    figures.min = std::min(figures.min, svf[r.index]);
    figures.max = std::max(figures.max, svf[r.index]);
  }
  return figures;
}

void add_figures(std::span<const CellFigures> cells, SvfRun& run) {
  CellFigures all;
  for (const CellFigures& c : cells) {
    if (c.count == 0) continue;
    all = {all.count + c.count, all.sum + c.sum, std::min(all.min, c.min), std::max(all.max, c.max)};
  }
  run.receivers = all.count;
  if (all.count == 0) return;
  run.svf_min = all.min;
  run.svf_max = all.max;
  run.svf_mean = all.sum / static_cast<double>(all.count);
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
  const SkyEvaluator reference(package, {Engine::exact, options.sky.weight, std::max(verify_rays, options.sky.rays)});
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

}  // namespace

void evaluate_cells(const Package& package, const SvfOptions& options, std::size_t cell_count,
                    const ReceiversOfCell& receivers_of, std::span<float> svf, SvfRun& run) {
  const SkyEvaluator evaluator(package, options.sky);
  std::vector<CellFigures> figures(cell_count);
  std::atomic<std::size_t> cells_done = 0, outside = 0;
  const auto start = Clock::now();
  {
    Progress progress("sky view factors", options.run.verbosity);
    oneapi::tbb::parallel_for(std::size_t{0}, cell_count, [&](std::size_t n) {
      const CellReceivers receivers = receivers_of(n);
      evaluator.evaluate(receivers, svf);
      figures[n] = figures_of(receivers, svf);
      if (!package.grid().cells.contains(receivers.cell)) outside += receivers.receivers.size();
      progress.update(++cells_done, cell_count);
    });
  }
  // Threads share the wall clock in proportion to what each part took of them
  const double wall_s = seconds_since(start);
  const auto [scenes_s, rays_s] = evaluator.effort();
  const double scene_share = scenes_s + rays_s > 0.0 ? scenes_s / (scenes_s + rays_s) : 0.0;
  run.seconds.scenes += wall_s * scene_share;
  run.seconds.evaluate += wall_s * (1.0 - scene_share);
  run.outside_of_grid = outside;
  add_figures(figures, run);
  if (options.verify_count > 0) run.errors = verify(package, options, figures, receivers_of, svf);
}

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

}  // namespace farlod
