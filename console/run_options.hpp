// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "console/progress.hpp"

namespace CLI {
class App;
}

namespace farlod {

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
