// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "results/picture/drawing.hpp"
#include "results/picture/picture.hpp"

namespace farlod {

/// A meaning of the legend of a map.
struct LegendEntry {
  enum class Sign { box, line, none };  ///< words without a sign are muted
  Sign sign = Sign::none;
  Colour colour;
  std::string words;
};

using LegendRow = std::vector<LegendEntry>;

/// One after the other, in rows no wider than that: words without a sign stand alone, in several rows where one is too short, and
/// what no row can hold is shortened.
[[nodiscard]] std::vector<LegendRow> legend_in_rows(const std::vector<LegendEntry>& entries, double width);

void add_legend_rows(Drawing& drawing, PagePoint upper_left, const std::vector<LegendRow>& rows);

}  // namespace farlod
