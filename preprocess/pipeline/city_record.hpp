// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/problem.hpp"
#include "pipeline/block_plan.hpp"
#include "pipeline/pack.hpp"
#include "pipeline/pack_estimate.hpp"

namespace farlod::pipeline {

/// What is known of a city once it is cut: all that its package and its report say, but for the blocks. With SavedCity, another
/// process goes on from there as the one that cut it.
struct CityRecord {
  PackedCity result;  ///< without seconds; its manifest has no blocks yet
  PackMemory memory;
  BlockPlan plan;
  std::vector<double> costs;  ///< of the blocks of the plan
  std::vector<Problem> problems;
};

[[nodiscard]] std::string record_text(const CityRecord& record);
/// Nothing where the text is none.
[[nodiscard]] std::optional<CityRecord> city_record_from(const std::string& text);

}  // namespace farlod::pipeline
