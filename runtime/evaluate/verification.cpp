// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verification.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>

#include "base/expects.hpp"
#include "evaluate/quantity_table.hpp"

namespace farlod {
namespace {

/// Random receivers among all: for each cell, their numbers within the cell.
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
  settings.allowed_error.reset();
  Quantities further;
  further.svf_total = settings.further.svf_total;
  further.canopy = settings.further.canopy;
  settings.further = further;
  return settings;
}

/// Where the receivers of a cell stand in the package's CRS.
std::vector<VerifiedReceiver> placed(const CellReceivers& cell, const package::Manifest& m) {
  const Point2d corner = m.grid.corner_of(cell.cell);
  std::vector<VerifiedReceiver> receivers;
  for (const Receiver& r : cell.receivers)
    receivers.push_back(
        {m.projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, r.p_cell.z + m.height_origin_m}), 0.0F, 0.0F});
  return receivers;
}

/// What was found in a cell.
struct VerifiedCell {
  std::vector<VerifiedReceiver> receivers;
  std::vector<double> totals, exact_totals;

  void add(std::size_t k, float svf, float exact) {
    receivers[k].svf = svf;
    receivers[k].exact = exact;
  }
};

Verification joined(const std::vector<VerifiedCell>& cells, std::size_t rays) {
  Verification all;
  std::vector<double> totals, exact_totals;
  for (const VerifiedCell& cell : cells) {
    all.receivers.insert(all.receivers.end(), cell.receivers.begin(), cell.receivers.end());
    totals.insert(totals.end(), cell.totals.begin(), cell.totals.end());
    exact_totals.insert(exact_totals.end(), cell.exact_totals.begin(), cell.exact_totals.end());
  }
  if (!totals.empty()) {
    all.svf_total_errors = summarize_errors(totals, exact_totals);
    all.svf_total_errors->rays = rays;
  }
  std::vector<double> answers, exact;
  for (const VerifiedReceiver& r : all.receivers) {
    answers.push_back(r.svf);
    exact.push_back(r.exact);
  }
  all.errors = summarize_errors(answers, exact);
  all.errors.rays = rays;
  return all;
}

}  // namespace

ErrorSummary summarize_errors(std::span<const double> answers, std::span<const double> exact) {
  FARLOD_EXPECTS(answers.size() == exact.size());
  ErrorSummary summary{answers.size()};
  if (answers.empty()) return summary;
  std::vector<double> errors;
  for (std::size_t n = 0; n < answers.size(); ++n) {
    errors.push_back(std::abs(answers[n] - exact[n]));
    summary.mean_abs_error += errors.back();
    summary.bias += answers[n] - exact[n];
  }
  const auto count = static_cast<double>(errors.size());
  summary.mean_abs_error /= count;
  summary.bias /= count;
  std::sort(errors.begin(), errors.end());
  summary.p99_abs_error = errors[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
  summary.max_abs_error = errors.back();
  return summary;
}

std::vector<std::size_t> choose_some(std::size_t size, std::size_t count) {
  std::mt19937_64 random(20120901);  // its sequence is fixed by the standard; the distributions are not, hence the remainder
  std::set<std::size_t> chosen;
  if (count >= size) {
    for (std::size_t n = 0; n < size; ++n) chosen.insert(n);
  }
  // R. Floyd's algorithm: each subset is equally likely
  for (std::size_t last = size - std::min(count, size); last < size && count < size; ++last) {
    const std::size_t candidate = random() % (last + 1);
    chosen.insert(chosen.contains(candidate) ? last : candidate);
  }
  return {chosen.begin(), chosen.end()};
}

Verification verify(const SkyEvaluator& evaluator, const VerifySettings& settings, std::span<const std::size_t> counts,
                    CellsOfRun& cells) {
  const SkyEvaluator reference(evaluator, reference_settings(evaluator.settings()));
  const auto chosen = choose_receivers(counts, settings.receivers);
  std::vector<VerifiedCell> verified(counts.size());
  const std::optional<std::size_t> total = total_columns_of(evaluator.settings().further).total;
  oneapi::tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t n) {
    if (chosen[n].empty()) return;
    const CellReceivers all = cells.receivers(n);
    CellReceivers some{all.cell, {}};
    for (const std::size_t k : chosen[n]) some.receivers.push_back(all.receivers[k]);
    const SvfValues answers = values_of(evaluator, all, settings.bounds), exact = values_of(reference, some, false);
    verified[n].receivers = placed(some, evaluator.package().manifest());
    for (std::size_t k = 0; k < some.receivers.size(); ++k) {
      verified[n].add(k, answers.svf[chosen[n][k]], exact.svf[k]);
      if (!total) continue;
      verified[n].totals.push_back(answers.further_of(chosen[n][k])[*total]);
      verified[n].exact_totals.push_back(exact.further_of(k)[0]);
    }
  });
  return joined(verified, reference.settings().rays);
}

}  // namespace farlod
