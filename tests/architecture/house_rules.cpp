// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/house_rules.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>
#include <utility>

namespace farlod {
namespace {

constexpr std::size_t longest_file = 400;

/// Path and reason of each file that may be longer. Nobody has needed it so far.
constexpr std::array<std::pair<std::string_view, std::string_view>, 0> long_for_a_reason{};

bool begins_with_licence(const SourceFile& file, std::string_view mark) {
  const std::string licence = file.path.starts_with("preprocess/") ? "GPL-3.0-or-later" : "Apache-2.0";
  // A script's first line names its interpreter
  const std::size_t first = !file.lines.empty() && file.lines[0].starts_with("#!") ? 1 : 0;
  if (file.lines.size() < first + 2) return false;
  return file.lines[first] == std::string(mark) + " SPDX-FileCopyrightText: The Far-LoD authors" &&
         file.lines[first + 1] == std::string(mark) + " SPDX-License-Identifier: " + licence;
}

template <class Condition>
std::vector<std::string> paths_where(const std::vector<SourceFile>& tree, Condition condition) {
  std::vector<std::string> paths;
  for (const SourceFile& file : tree)
    if (condition(file)) paths.push_back(file.path);
  return paths;
}

}  // namespace

std::vector<std::string> files_without_licence(const std::vector<SourceFile>& tree) {
  return paths_where(tree, [](const SourceFile& file) { return !begins_with_licence(file, is_cpp(file) ? "//" : "#"); });
}

std::vector<std::string> files_too_long(const std::vector<SourceFile>& tree) {
  return paths_where(tree, [](const SourceFile& file) {
    const bool excused =
        std::any_of(long_for_a_reason.begin(), long_for_a_reason.end(), [&](const auto& e) { return e.first == file.path; });
    return is_cpp(file) && file.lines.size() > longest_file && !excused;
  });
}

std::vector<std::string> files_with_empty_names(const std::vector<SourceFile>& tree) {
  static const std::regex empty_name("(^|[/_])(utils?|utilities|helpers?|common|misc|manager)([/_.]|$)");
  return paths_where(tree, [](const SourceFile& file) { return std::regex_search(file.path, empty_name); });
}

std::vector<std::string> files_with_notes_to_self(const std::vector<SourceFile>& tree) {
  // Spelt in two parts, so that this file does not find itself
  static const std::regex note(
      "\\b(TO"
      "DO|FIX"
      "ME|XX"
      "X|HA"
      "CK)\\b");
  const auto has_note = [](const std::string& line) { return std::regex_search(line, note); };
  return paths_where(tree, [&](const SourceFile& file) { return std::any_of(file.lines.begin(), file.lines.end(), has_note); });
}

}  // namespace farlod
