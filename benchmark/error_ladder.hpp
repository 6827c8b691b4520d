// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace farlod::benchmark {

struct Errors {
  double mean_abs = 0.0, rms = 0.0, max_abs = 0.0;
};
/// Of the same length, at least one.
[[nodiscard]] Errors errors_of(std::span<const float> answers, std::span<const float> truth);

/// One accuracy that a method can be set to: so many rays, or azimuths.
struct Rung {
  std::size_t samples = 0;
  Errors errors;
};

/// The errors at each number of samples. `answer` gives the answers of the receivers whose truth is known.
using Answer = std::function<std::vector<float>(std::size_t samples)>;
[[nodiscard]] std::vector<Rung> climb(std::span<const std::size_t> ladder, const Answer& answer, std::span<const float> truth);

/// The lowest rung whose largest error is at most this; none when no rung is.
[[nodiscard]] std::optional<Rung> rung_within(std::span<const Rung> rungs, double max_error);

}  // namespace farlod::benchmark
