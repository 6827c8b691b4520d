// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace farlod::package {

/// Consecutive cells of a block, by their places in CellRange::index_of; half open.
struct CellRun {
  std::uint32_t begin = 0, end = 0;
  bool operator==(const CellRun&) const = default;
};

/// Some of a block's cells. The runs ascend, and are neither empty nor adjacent, so that a set of cells has one form.
struct CellRuns {
  std::vector<CellRun> runs;
  bool operator==(const CellRuns&) const = default;

  /// The runs of places that ascend.
  [[nodiscard]] static CellRuns of(std::span<const std::size_t> places) {
    CellRuns result;
    for (const std::size_t place : places) {
      const auto n = static_cast<std::uint32_t>(place);
      if (!result.runs.empty() && result.runs.back().end == n) {
        ++result.runs.back().end;
      } else {
        result.runs.push_back({n, n + 1});
      }
    }
    return result;
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const CellRun& run : runs) count += run.end - run.begin;
    return count;
  }
  [[nodiscard]] bool contains(std::size_t place) const {
    const auto after =
        std::upper_bound(runs.begin(), runs.end(), place, [](std::size_t p, const CellRun& r) { return p < r.begin; });
    return after != runs.begin() && place < (after - 1)->end;
  }
  /// How many of the cells come before a place.
  [[nodiscard]] std::size_t count_before(std::size_t place) const {
    std::size_t count = 0;
    for (const CellRun& run : runs) {
      if (place <= run.begin) break;
      count += std::min<std::size_t>(place, run.end) - run.begin;
    }
    return count;
  }
  [[nodiscard]] std::vector<std::size_t> places() const {
    std::vector<std::size_t> result;
    for (const CellRun& run : runs)
      for (std::size_t place = run.begin; place < run.end; ++place) result.push_back(place);
    return result;
  }
};

}  // namespace farlod::package
