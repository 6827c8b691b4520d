// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "farlod/error.hpp"

namespace farlod {

/// Called wherever a run may end within some milliseconds: in each round of a long loop.
inline void throw_if_cancelled(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled("the run was cancelled");
}

}  // namespace farlod
