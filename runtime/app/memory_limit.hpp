// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>

#include "app/svf_options.hpp"
#include "package/package.hpp"

namespace farlod {

/// The work needs more memory than the user gives it. The message says what to do.
class LimitReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a run holds besides the package.
struct MemoryNeeds {
  std::uint64_t results = 0;            ///< bytes, however many threads there are
  std::uint64_t receivers_of_cell = 0;  ///< the most receivers of a cell, as far as they are known beforehand
  bool whole_city = false;              ///< everything in one scene, whatever the options
};

/// Cells that are worked on at the same time.
[[nodiscard]] std::size_t cells_in_flight(const RunOptions& options);

/// Lets the package hold the blocks that the cells in flight need, and no more. Throws LimitReached when the run needs more
/// memory than the user gives it. Where the user says nothing, there is no limit to reach: what a run takes does not grow with
/// the city, unless the whole city has to be one scene.
void share_memory(Package& package, const SvfOptions& options, const MemoryNeeds& needs);

}  // namespace farlod
