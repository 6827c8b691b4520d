// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

/// What the programs return. Scripts rely on the numbers.
enum ExitCode : int {
  exit_done = 0,
  exit_internal = 1,        ///< a fault of ours
  exit_usage = 2,           ///< the command line cannot be understood
  exit_unusable_input = 3,  ///< an input cannot be read or used, or an output cannot be written
  exit_damaged_package = 4,
  exit_limit_reached = 5,  ///< memory
};

}  // namespace farlod
