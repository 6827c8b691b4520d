// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/help_text.hpp"

#include <regex>

#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {

std::set<std::string> options_in(const std::string& help) {
  static const std::regex option("^ +(?:-[a-z],)?(--[a-z0-9-]+).*");
  std::set<std::string> options;
  for (const std::string& line : lines_of(help)) {
    std::smatch found;
    if (std::regex_match(line, found, option)) options.insert(found[1]);
  }
  return options;
}

}  // namespace farlod::acceptance
