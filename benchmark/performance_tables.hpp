// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmark/city_sizes.hpp"
#include "benchmark/contest.hpp"
#include "benchmark/rival_variants.hpp"
#include "benchmark/sweep_study.hpp"

namespace farlod::benchmark {

/// All that is measured in one run.
struct Results {
  Extent extent;
  OurEngine ours;
  std::string city;  ///< what the contests' city is
  std::vector<Contest> contests;
  std::vector<ContestRow> same_directions;
  SweepStudy sweep;
  VariantTable variants;
  std::vector<SizeRow> sizes;
};

/// The tables behind docs/performance.md.
[[nodiscard]] std::string markdown(const Results& results);

}  // namespace farlod::benchmark
