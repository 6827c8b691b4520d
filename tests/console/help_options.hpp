// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <set>
#include <string>

namespace farlod::test {

/// The long names of the options that a help text lists: they begin a line, behind two blanks, or four in a group of options,
/// and perhaps a short name.
inline std::set<std::string> options_in(const std::string& help) {
  static const std::regex option(R"(\n {2,4}(?:-\w,)?(--[\w-]+))");
  std::set<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

}  // namespace farlod::test
