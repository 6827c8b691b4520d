// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <istream>
#include <iterator>
#include <memory>
#include <sstream>
#include <thread>

#include "console/option_list.hpp"
#include "console/run_options.hpp"
#include "farlod/version.hpp"

namespace farlod {

void describe_program(CLI::App& app, const ProgramDescription& program) {
  std::string beginning = program.name + " — " + program.purpose + ".\n\nTry this first:\n";
  for (const std::string& example : program.examples) beginning.append("  ").append(example).append("\n");
  std::string end = "\nMore:\n";
  for (const std::string& paragraph : program.background) end.append(paragraph).append("\n");
  end.append("\nExit codes:\n");
  for (const ExitMeaning& meaning : program.exit_codes)
    end += fmt::format("  {:<5}{}\n", static_cast<int>(meaning.code), meaning.text);
  app.name(program.name);
  app.description(beginning);
  app.footer(end + "\nCopyright The Far-LoD authors; licence: " + program.licence);
}

namespace {

/// A file of --config: TOML, or the summary of a run, whose settings it repeats.
class SettingsFile : public CLI::ConfigTOML {
 public:
  std::vector<CLI::ConfigItem> from_config(std::istream& file) const override {
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string::npos && text[first] == '{') return of_summary(text);
    std::istringstream toml(text);
    return CLI::ConfigTOML::from_config(toml);
  }

 private:
  static std::vector<CLI::ConfigItem> of_summary(const std::string& json) {
    const auto settings = settings_of_summary(json);
    if (!settings)
      throw CLI::ValidationError("--config", "the file is neither the summary of a run (--summary) with its settings, nor TOML");
    std::vector<CLI::ConfigItem> items;
    for (const GivenOption& option : *settings) items.push_back({{}, option.name, option.values});
    return items;
  }
};

/// What a repeated run says for itself.
constexpr std::array options_of_this_run{"help", "version", "config", "summary"};

void add_given(const CLI::App& app, std::vector<GivenOption>& given) {
  for (const CLI::Option* o : app.get_options([](const CLI::Option* each) { return each->count() > 0; })) {
    const std::string name = o->get_lnames().empty() ? o->get_name(true) : o->get_lnames().front();
    if (std::ranges::find(options_of_this_run, name) == options_of_this_run.end()) given.push_back({name, o->results()});
  }
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; })) add_given(*group, given);
}

}  // namespace

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
  app.add_option("--threads", o.threads, "Threads to use (default: all cores)")->check(between(1, 4096))->group("Run");
  app.set_config("--config", "", "Read options from this file: TOML, or the --summary of a run, to repeat it")
      ->type_name(file_value)
      ->group("Run");
  app.config_formatter(std::make_shared<SettingsFile>());
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.set_version_flag("--version", program + " " + software_version);
  app.get_formatter()->column_width(34);
  app.callback([&app, &o] {
    std::vector<GivenOption> given;
    add_given(app, given);
    o.settings_json = settings_json(given);
  });
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
