// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/hilbert_curve.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

std::int64_t border_below(std::int64_t cell, std::int64_t block_edge) {
  return cell - ((cell % block_edge) + block_edge) % block_edge;
}

}  // namespace

std::uint64_t hilbert_index(Cell cell, int order) {
  FARLOD_EXPECTS(cell.i >= 0 && cell.j >= 0 && std::int64_t{cell.i | cell.j} >> order == 0);
  std::uint64_t index = 0;
  auto x = static_cast<std::uint64_t>(cell.i), y = static_cast<std::uint64_t>(cell.j);
  for (std::uint64_t half = std::uint64_t{1} << order >> 1; half > 0; half >>= 1) {
    // Which quarter of the square, in the order in which the curve meets them (D. Hilbert 1891)
    const bool is_east = (x & half) != 0, is_north = (y & half) != 0;
    index += half * half * (is_east ? (is_north ? 2U : 3U) : (is_north ? 1U : 0U));
    x &= half - 1;
    y &= half - 1;
    if (is_north) continue;
    // The curve lies turned over in the two southern quarters: along the diagonal in the first, across it in the last
    if (is_east) std::tie(x, y) = std::pair(half - 1 - x, half - 1 - y);
    std::swap(x, y);
  }
  return index;
}

std::vector<Cell> along_hilbert_curve(std::vector<Cell> cells, std::int32_t block_edge) {
  if (cells.empty()) return cells;
  const auto [west, east] = std::minmax_element(cells.begin(), cells.end(), [](Cell a, Cell b) { return a.i < b.i; });
  const auto [south, north] = std::minmax_element(cells.begin(), cells.end(), [](Cell a, Cell b) { return a.j < b.j; });
  const std::int64_t i_0 = border_below(west->i, block_edge), j_0 = border_below(south->j, block_edge);
  const std::int64_t longest = std::max(east->i - i_0, north->j - j_0);
  FARLOD_EXPECTS(longest <= std::numeric_limits<std::int32_t>::max());
  const auto order = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(longest)));
  std::vector<std::pair<std::uint64_t, Cell>> places;
  places.reserve(cells.size());
  for (const Cell c : cells)
    places.emplace_back(hilbert_index({static_cast<std::int32_t>(c.i - i_0), static_cast<std::int32_t>(c.j - j_0)}, order), c);
  std::sort(places.begin(), places.end());
  for (std::size_t n = 0; n < cells.size(); ++n) cells[n] = places[n].second;
  return cells;
}

}  // namespace farlod
