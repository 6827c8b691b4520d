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
  exit_busy = 6,           ///< another process is at work on the same output: try again later
  /// And the number of the signal that asked the program to end, as shells count: 130 for Ctrl-C, 143 for SIGTERM.
  exit_interrupted = 128,
};

}  // namespace farlod
