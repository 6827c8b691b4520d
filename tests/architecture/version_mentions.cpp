// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/version_mentions.hpp"

#include <algorithm>
#include <regex>

namespace farlod {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the characters [begin, end) are followed or preceded by more of a number. A full stop ends a sentence; a point
/// beside a digit belongs to a number.
bool is_part_of_longer(std::string_view line, std::size_t begin, std::size_t end) {
  const std::string_view before = line.substr(0, begin), after = line.substr(end);
  if (!before.empty() && (is_digit(before.back()) || before.back() == '.')) return true;
  return !after.empty() && (is_digit(after[0]) || (after.size() > 1 && after[0] == '.' && is_digit(after[1])));
}

bool mentions(std::string_view line, std::string_view version) {
  for (std::size_t at = line.find(version); at != std::string_view::npos; at = line.find(version, at + 1))
    if (!is_part_of_longer(line, at, at + version.size())) return true;
  return false;
}

}  // namespace

std::vector<std::string> mentions_of_version(const std::vector<SourceFile>& files, std::string_view version) {
  std::vector<std::string> found;
  for (const SourceFile& file : files)
    for (std::size_t n = 0; n < file.lines.size(); ++n)
      if (mentions(file.lines[n], version)) found.push_back(file.path + ":" + std::to_string(n + 1));
  return found;
}

std::string topmost_release(const SourceFile& changelog) {
  static const std::regex release(R"(^## \[(\d+\.\d+\.\d+)\].*)");
  for (const std::string& line : changelog.lines) {
    std::smatch match;
    if (std::regex_match(line, match, release)) return match[1];
  }
  return "";
}

}  // namespace farlod
