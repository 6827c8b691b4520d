// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/measurement.hpp"

#include <algorithm>

#include "base/expects.hpp"

namespace farlod::benchmark {

double median(std::vector<double> values) {
  FARLOD_EXPECTS(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Duel duel(std::size_t turns, const std::function<void()>& first, const std::function<void()>& second) {
  std::vector<double> first_s, second_s, ratio;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    first_s.push_back(seconds_of(first));
    second_s.push_back(seconds_of(second));
    ratio.push_back(second_s.back() / first_s.back());
  }
  return {median(first_s), median(second_s), median(ratio)};
}

double median_seconds(std::size_t turns, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (std::size_t turn = 0; turn < turns; ++turn) seconds.push_back(seconds_of(work));
  return median(seconds);
}

}  // namespace farlod::benchmark
