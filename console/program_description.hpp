// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "farlod/error.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// What a program's exit code tells.
struct ExitMeaning {
  ExitCode code;
  std::string text;
};

/// What a program says of itself, in --help and in its manual page. Its options say the rest.
struct ProgramDescription {
  std::string name;
  std::string purpose;                  ///< what it does, as the name goes on: "makes test cities"
  std::vector<std::string> examples;    ///< command lines
  std::vector<std::string> background;  ///< paragraphs of the manual page, too long for --help
  std::vector<std::string> notes;       ///< paragraphs of both
  std::vector<ExitMeaning> exit_codes;  ///< ascending
  std::vector<std::string> see_also;    ///< programs
  std::string licence;                  ///< its SPDX identifier
};

/// Takes the command line of a program as CLI11 knows it, without running the program.
using CommandLineVisitor = std::function<void(const ProgramDescription&, const CLI::App&)>;

/// Lets --help begin with the purpose and the examples, and end with the notes and the exit codes.
void describe_program(CLI::App& app, const ProgramDescription& program);

}  // namespace farlod
