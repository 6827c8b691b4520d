// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <string>

#include "console/program_description.hpp"

namespace farlod {

void describe_program(CLI::App& app, const ProgramDescription& program) {
  std::string beginning = program.name + " — " + program.purpose + ".\n\nTry this first:\n";
  for (const std::string& example : program.examples) beginning.append("  ").append(example).append("\n");
  std::string end = "\n";
  for (const std::string& note : program.notes) end.append(note).append("\n");
  end.append("Exit codes:");
  for (const ExitMeaning& meaning : program.exit_codes)
    end.append(meaning.code == exit_done ? " " : ", ").append(std::to_string(meaning.code)).append(" ").append(meaning.text);
  app.name(program.name);
  app.description(beginning);
  app.footer(end + ".");
}

}  // namespace farlod
