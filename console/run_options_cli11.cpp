// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/run_options.hpp"

#include <CLI/CLI.hpp>
#include <thread>

#include "console/exit_code.hpp"
#include "console/option_list.hpp"
#include "farlod/version.hpp"

namespace farlod {

std::size_t thread_count(const RunOptions& options) {
  return options.threads > 0 ? static_cast<std::size_t>(options.threads) : std::thread::hardware_concurrency();
}

void add_run_options(CLI::App& app, const std::string& program, RunOptions& o) {
  app.add_option("--summary", o.summary_file, "Write counts, times and figures to this JSON file")
      ->type_name(file_value)
      ->group("Output");
  app.add_flag_callback(
         "--quiet", [&o] { o.verbosity = Verbosity::quiet; }, "Say nothing but errors")
      ->group("Run");
  app.add_option("--threads", o.threads, "Threads to use (default: all cores)")->check(CLI::Range(1, 4096))->group("Run");
  app.set_config("--config", "", "Read options from this file (TOML)")->type_name(file_value)->group("Run");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.set_version_flag("--version", program + " " + software_version);
  app.get_formatter()->column_width(34);
}

std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv, const std::function<void()>& resolve) {
  try {
    app.parse(argc, argv);
    resolve();
  } catch (const CLI::ConfigError& error) {
    app.exit(
        CLI::ValidationError("--config", std::string(error.what()) + ": name its options as --help does, without the dashes"));
    return exit_usage;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  return std::nullopt;
}

}  // namespace farlod
