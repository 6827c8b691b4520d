// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace farlod::analytic {

/// One value of each parameter, by its number.
using Row = std::vector<std::size_t>;

/// Adds rows of `possible` to `first` until each pair of values of two parameters that is in a row of `possible` is in a row of
/// the result. The same rows for the same arguments. They are few: each row that is added has the most new pairs.
[[nodiscard]] std::vector<Row> with_all_pairs(std::vector<Row> first, std::vector<Row> possible);

}  // namespace farlod::analytic
