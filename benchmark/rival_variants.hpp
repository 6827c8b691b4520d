// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "benchmark/contest.hpp"

namespace farlod::benchmark {

/// One way to use Embree, beside the way that is measured everywhere else.
struct VariantRow {
  std::string name;
  double build_s = 0.0, ground_s = 0.0, facades_s = 0.0;
  double ground_ratio = 0.0, facades_ratio = 0.0;  ///< of the time that the measured one takes, within a turn
};
struct VariantTable {
  std::size_t rays = 0, ground_receivers = 0, facade_receivers = 0;
  std::vector<VariantRow> rows;
};

/// All the ways that were tried, to see that the rival is at its best.
[[nodiscard]] VariantTable study_variants(const City& city, const Extent& extent);

}  // namespace farlod::benchmark
