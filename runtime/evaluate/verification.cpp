// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/verification.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>

#include "farlod/expects.hpp"

namespace farlod {

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

}  // namespace farlod
