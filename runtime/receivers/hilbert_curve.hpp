// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.hpp"

namespace farlod {

/// The place of a cell along Hilbert's curve through the square of 2^`order` × 2^`order` cells whose south-west one is (0, 0);
/// the cell must lie in it, and `order` be 31 at the most.
///   (1) each cell has a place of its own, from 0 to 4^order − 1
///   (2) cells that follow each other along the curve share an edge
[[nodiscard]] std::uint64_t hilbert_index(Cell cell, int order);

/// Orders cells along Hilbert's curve through them all, so that few neighborhoods are needed at any time. The order is the same
/// for the same cells, however they are given. Where a block's edge is a power of two, as it is unless somebody wished otherwise,
/// the curve leaves a block only when it has met all of its cells.
[[nodiscard]] std::vector<Cell> along_hilbert_curve(std::vector<Cell> cells, std::int32_t block_edge);

}  // namespace farlod
