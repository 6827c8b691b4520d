// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "farlod/run.hpp"

namespace farlod {

/// Calls `work` with the numbers of some cells, on the threads of a run, and tells its progress. Throws Cancelled.
void for_each_cell(std::size_t count, const RunSettings& run, const char* stage, const std::function<void(std::size_t)>& work);

}  // namespace farlod
