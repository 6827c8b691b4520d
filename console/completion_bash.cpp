// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "console/completion.hpp"

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

constexpr const char* end = R"(}
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
  return with(with(script + end, "FUNCTION", function), "PROGRAM", program);
}

}  // namespace farlod
