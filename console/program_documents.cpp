// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/program_documents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

#include "console/run_program.hpp"

namespace farlod {
namespace {

constexpr const char* bash_beginning = R"(# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash

FUNCTION() {
  local current="${COMP_WORDS[COMP_CWORD]}" before=""
  ((COMP_CWORD > 0)) && before="${COMP_WORDS[COMP_CWORD - 1]}"
  # To bash, --option=value is three words
  if [[ $current == "=" ]]; then
    current=""
  elif [[ $before == "=" ]]; then
    before="${COMP_WORDS[COMP_CWORD - 2]}"
  fi
  COMPREPLY=()
  case "$before" in
)";

constexpr const char* middle = R"(  esac
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "OPTIONS" -- "$current")
    return
  fi
)";

constexpr const char* end_of_script = R"(}
complete -F FUNCTION PROGRAM
)";

std::string with(std::string text, std::string_view placeholder, std::string_view value) {
  for (std::size_t at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at + value.size()))
    text.replace(at, placeholder.size(), value);
  return text;
}

/// The statement that completes a value.
std::string completed(const OptionDescription& option) {
  const std::string offered = !option.choices.empty()        ? fmt::format("-W \"{}\"", fmt::join(option.choices, " "))
                              : option.value == folder_value ? "-d"
                              : option.value == file_value   ? "-f"
                                                             : "";
  if (offered.empty()) return ":";
  const std::string statement = "mapfile -t COMPREPLY < <(compgen " + offered + " -- \"$current\")";
  // Only names of files get a slash, or quotes, as they need; outside of a completion compopt fails
  return option.choices.empty() ? "compopt -o filenames 2>/dev/null; " + statement : statement;
}

/// The cases of all options that have values, those with the same values together.
std::string cases_of(const OptionList& list) {
  std::map<std::string, std::vector<std::string>> names_by_statement;
  for (const OptionGroup& group : list.groups)
    for (const OptionDescription& option : group.options) {
      if (option.value.empty()) continue;
      std::vector<std::string>& names = names_by_statement[completed(option)];
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
  std::string cases;
  for (const auto& [statement, names] : names_by_statement)
    cases += fmt::format("    {})\n      {}\n      return\n      ;;\n", fmt::join(names, " | "), statement);
  return cases;
}

}  // namespace

std::string bash_completion(const std::string& program, const OptionList& options) {
  std::vector<std::string> names;
  for (const OptionGroup& group : options.groups)
    for (const OptionDescription& option : group.options) names.insert(names.end(), option.names.begin(), option.names.end());
  std::string function = "_" + program;
  std::ranges::replace(function, '-', '_');
  std::string script = bash_beginning + cases_of(options) + with(middle, "OPTIONS", fmt::format("{}", fmt::join(names, " ")));
  script += options.arguments.empty() ? "" : "  " + completed(options.arguments.front()) + "\n";
  return with(with(script + end_of_script, "FUNCTION", function), "PROGRAM", program);
}

namespace {

constexpr const char* zsh_beginning = R"(
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

_arguments -S \
)";

/// Text within a specification of _arguments, within single quotes.
std::string within_quotes(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '[' || c == ']' || c == ':') result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

/// What _arguments does for a value. A blank offers nothing.
std::string action_of(const OptionDescription& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  if (option.value == folder_value) return "_files -/";
  return option.value == file_value ? "_files" : " ";
}

std::string value_of(const OptionDescription& option) {
  const std::string message = option.range.empty() ? option.value : option.value + ", " + option.range;
  return option.value.empty() ? "" : ":" + within_quotes(message) + ":" + action_of(option);
}

/// The options that go when one of the names of this option is given: its other names, and what it excludes.
std::string excluded_by(const std::string& name, const OptionDescription& option, const OptionGroup& group) {
  std::vector<std::string> names = option.names;
  names.insert(names.end(), option.excluded.begin(), option.excluded.end());
  for (const OptionDescription& other : group.options)
    if (group.exactly_one && &other != &option) names.insert(names.end(), other.names.begin(), other.names.end());
  std::erase(names, name);
  return names.empty() ? "" : fmt::format("({})", fmt::join(names, " "));
}

std::string specifications(const OptionDescription& option, const OptionGroup& group) {
  std::string lines;
  for (const std::string& name : option.names) {
    // The value may follow at once: -oFILE, --output=FILE
    const std::string sign = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    lines += fmt::format("  '{}{}{}[{}]{}' \\\n", excluded_by(name, option, group), name, sign, within_quotes(option.text),
                         value_of(option));
  }
  return lines;
}

std::string specification_of_argument(const OptionDescription& argument) {
  const char* place = argument.repeatable ? "*" : "1";
  return fmt::format("  '{}:{}:{}' \\\n", place, within_quotes(argument.names.front()), action_of(argument));
}

}  // namespace

std::string zsh_completion(const std::string& program, const OptionList& options) {
  std::string script = "#compdef " + program + zsh_beginning;
  for (const OptionGroup& group : options.groups)
    for (const OptionDescription& option : group.options) script += specifications(option, group);
  for (const OptionDescription& argument : options.arguments) script += specification_of_argument(argument);
  // All lines but the last go on
  return script.substr(0, script.rfind(" \\")) + "\n";
}

namespace {

void write_documents(const std::filesystem::path& folder, const ProgramDescription& program, const CLI::App& app) {
  const OptionList options = options_of(app);
  write_text(folder / (program.name + ".bash"), bash_completion(program.name, options));
  write_text(folder / (program.name + ".zsh"), zsh_completion(program.name, options));
}

}  // namespace

int write_program_documents(int argc, char** argv, const std::function<void(const CommandLineVisitor&)>& describe) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} FOLDER\n", argv[0]);
    return exit_usage;
  }
  try {
    describe([&](const ProgramDescription& program, const CLI::App& app) { write_documents(argv[1], program, app); });
    return exit_done;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return exit_unusable_input;
  }
}

}  // namespace farlod
