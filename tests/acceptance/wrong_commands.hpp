// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "farlod/error.hpp"

namespace farlod::acceptance {

/// A command that is wrong, or unlucky, and what its user must be told. It runs where WrongCommands has put files.
struct WrongCommand {
  std::string command;
  int exit_code = exit_usage;
  std::vector<std::string> said;
};
inline void PrintTo(const WrongCommand& wrong, std::ostream* out) { *out << wrong.command; }

/// What is wrong can be known from the words alone.
[[nodiscard]] std::vector<WrongCommand> wrong_options();
/// Files and folders are not what they are given for, or outputs cannot be written; or nothing lies where something is asked.
[[nodiscard]] std::vector<WrongCommand> wrong_files();

}  // namespace farlod::acceptance
