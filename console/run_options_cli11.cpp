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
#include <utility>

#include "console/option_list.hpp"
#include "console/run_options.hpp"
#include "console/wrong_usage.hpp"
#include "farlod/version.hpp"

namespace farlod {

namespace {

/// CLI11 tells groups of options of which one must be chosen last, below "[Option Group: NAME]". They are what one looks for.
class ChoicesFirst : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) + make_subcommands(app, mode) +
           make_groups(app, mode) + '\n' + make_footer(app);
  }
  std::string make_expanded(const CLI::App* group) const override {
    const std::string text = CLI::Formatter::make_expanded(group);
    return "\n" + group->get_group() + ":" + text.substr(text.find('\n'));
  }
};

}  // namespace

void describe_program(CLI::App& app, const ProgramDescription& program) {
  std::string beginning = program.name + " — " + program.purpose + ".\n\nTry this first:\n";
  for (const std::string& example : program.examples) beginning.append("  ").append(example).append("\n");
  std::string end = "\nMore:\n";
  for (const std::string& paragraph : program.background) end.append(paragraph).append("\n");
  end.append("\nExit codes:\n");
  for (const ExitMeaning& meaning : program.exit_codes)
    end += fmt::format("  {:<5}{}\n", static_cast<int>(meaning.code), meaning.text);
  app.name(program.name);
  app.formatter(std::make_shared<ChoicesFirst>());
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    const std::string what = error.what();
    return fmt::format("{}: {}{} --help tells all options.\n", failed->get_name(), what,
                       what.ends_with('.') || what.ends_with('?') ? "" : ".");
  });
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
    require_no_option_as_value(app);
    resolve();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return exit_done;
    }
    app.exit(CLI::ValidationError(wrong_usage_text(app, error)));
    return exit_usage;
  }
  return std::nullopt;
}

}  // namespace farlod
