// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace farlod {

/// How far answers are from the exact ones: |difference| summed up, and the mean difference (bias, answer − exact).
struct ErrorSummary {
  std::size_t count = 0;
  double mean_abs_error = 0.0, p99_abs_error = 0.0, max_abs_error = 0.0, bias = 0.0;
};

/// `answers` and `exact` are of the same length. The 99th percentile is the smallest error that 99 % do not exceed.
[[nodiscard]] ErrorSummary summarize_errors(std::span<const double> answers, std::span<const double> exact);

/// `count` different numbers below `size` (all of them when there are fewer), ascending. The same for the same arguments,
/// on every machine.
[[nodiscard]] std::vector<std::size_t> choose_some(std::size_t size, std::size_t count);

}  // namespace farlod
