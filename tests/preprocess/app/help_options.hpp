// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace farlod::test {

/// What a program prints for --help.
inline std::string help_of(const std::string& program) {
  const std::string command = "'" + std::string(FARLOD_BIN_DIR) + "/" + program + "' --help";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) throw std::runtime_error(command + " cannot be run");
  std::string text;
  std::array<char, 4096> piece{};
  for (std::size_t count = 0; (count = fread(piece.data(), 1, piece.size(), pipe.get())) > 0;) text.append(piece.data(), count);
  return text;
}

/// The long names of the options that a help text lists: they begin a line, behind two blanks and perhaps a short name.
inline std::set<std::string> options_in(const std::string& help) {
  static const std::regex option(R"(\n  (?:-\w,)?(--[\w-]+))");
  std::set<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

}  // namespace farlod::test
