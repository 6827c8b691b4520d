// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/error_ladder.hpp"

#include <algorithm>
#include <cmath>

#include "base/expects.hpp"

namespace farlod::benchmark {

Errors errors_of(std::span<const float> answers, std::span<const float> truth) {
  FARLOD_EXPECTS(answers.size() == truth.size() && !truth.empty());
  Errors errors;
  double squares = 0.0;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const double error = std::abs(static_cast<double>(answers[n]) - static_cast<double>(truth[n]));
    errors.mean_abs += error / static_cast<double>(truth.size());
    squares += error * error;
    errors.max_abs = std::max(errors.max_abs, error);
  }
  errors.rms = std::sqrt(squares / static_cast<double>(truth.size()));
  return errors;
}

std::vector<Rung> climb(std::span<const std::size_t> ladder, const Answer& answer, std::span<const float> truth) {
  std::vector<Rung> rungs;
  for (const std::size_t samples : ladder) rungs.push_back({samples, errors_of(answer(samples), truth)});
  return rungs;
}

std::optional<Rung> rung_within(std::span<const Rung> rungs, double max_error) {
  const auto found = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& r) { return r.errors.max_abs <= max_error; });
  return found == rungs.end() ? std::nullopt : std::optional(*found);
}

}  // namespace farlod::benchmark
