// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "console/completion.hpp"

namespace farlod {
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

}  // namespace farlod
