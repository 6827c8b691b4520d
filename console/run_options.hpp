// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "console/progress.hpp"
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

/// What a program says of itself in --help, of which its manual page is made. Its options say the rest.
struct ProgramDescription {
  std::string name;
  std::string purpose;                  ///< what it does, as the name goes on: "makes test cities"
  std::vector<std::string> examples;    ///< command lines
  std::vector<std::string> background;  ///< paragraphs
  std::vector<ExitMeaning> exit_codes;  ///< ascending
  std::string licence;                  ///< its SPDX identifier
};

/// Takes the command line of a program as CLI11 knows it, without running the program.
using CommandLineVisitor = std::function<void(const ProgramDescription&, const CLI::App&)>;

/// Lets --help begin with the purpose and the examples, and end with the background, the exit codes and the licence.
/// cmake/manual_page knows its headings.
void describe_program(CLI::App& app, const ProgramDescription& program);

/// An option as it was given, by its long name without dashes, or an argument by its own. That of a flag is "true".
struct GivenOption {
  std::string name;
  std::vector<std::string> values;
};

/// A JSON object with a member for each option: a text, or a list of texts where there are several.
[[nodiscard]] std::string settings_json(std::span<const GivenOption> options);

/// The options in a summary, which has that object as its member `settings`. Empty where the text is no JSON object with that
/// member.
[[nodiscard]] std::optional<std::vector<GivenOption>> settings_of_summary(const std::string& json);

/// What every program can be told.
struct RunOptions {
  std::string summary_file;  ///< empty: none
  int threads = 0;           ///< 0: all cores
  Verbosity verbosity = Verbosity::normal;
  std::string settings_json;  ///< what was given, for the summary (settings_of_summary)
};

[[nodiscard]] std::size_t thread_count(const RunOptions& options);

/// Adds --summary, --quiet, --threads, --config and --version. The options must outlive the parsing.
void add_run_options(CLI::App& app, const std::string& program, RunOptions& options);

/// Parses the command line, then calls `resolve`, which may throw CLI::ValidationError.
/// Returns the exit code when the program has nothing left to do: after --help and --version, or when the command line is wrong;
/// what there is to say has been said then.
[[nodiscard]] std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv, const std::function<void()>& resolve);

}  // namespace farlod
