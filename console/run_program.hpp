// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace farlod {

/// What a program says where a run ends before its end.
struct ProgramName {
  std::string name;                     ///< begins each line on standard error
  std::string when_interrupted = {};    ///< what is left of the work, and how to go on
  std::string when_out_of_memory = {};  ///< how to need less
  std::string at_limit = {};            ///< goes on behind LimitReached: the options that decide what is needed
};

/// Runs a program, and tells on standard error, in one line, what ended it: main() of each program. Returns its exit code.
[[nodiscard]] int run_program(const ProgramName& program, const std::function<int()>& run);

}  // namespace farlod
