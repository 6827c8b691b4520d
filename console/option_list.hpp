// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace farlod {

/// Checks that an option is a number from `low` to `high`. CLI11's own Range accepts NaN, which is neither below
/// nor above, and says something else in each version.
[[nodiscard]] CLI::Validator between(double low, double high);

/// What --help calls the value of an option that names a file, or a folder; completion offers those that are there.
inline constexpr const char* file_value = "FILE";
inline constexpr const char* folder_value = "FOLDER";

/// An option as users see it, or an argument without dashes.
struct OptionDescription {
  std::vector<std::string> names;  ///< with their dashes, short ones first; of an argument its only name
  std::string value;               ///< what --help calls its value: "FLOAT", `file_value`; empty for a flag
  std::vector<std::string> choices;
  std::string range;     ///< of numbers: "from 0 to 10"; other conditions in the words of --help
  std::string standard;  ///< the value that it has when it is left out, when there is one
  std::string text;
  bool required = false, repeatable = false;
  std::vector<std::string> excluded;  ///< names of options that may not be given, too
};

/// Options below one heading of --help.
struct OptionGroup {
  std::string name, text;    ///< of the heading, and perhaps a line below it
  bool exactly_one = false;  ///< one of these options must be given, and no other of them
  std::vector<OptionDescription> options;
};

struct OptionList {
  std::vector<OptionDescription> arguments;
  std::vector<OptionGroup> groups;  ///< those of which one option is required first, --help and --version last
};

/// An option as --help shows it.
[[nodiscard]] OptionDescription description_of(const CLI::Option& option);

/// All options that --help shows.
[[nodiscard]] OptionList options_of(const CLI::App& app);

}  // namespace farlod
