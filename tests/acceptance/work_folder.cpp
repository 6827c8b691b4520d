// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/work_folder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <regex>
#include <sstream>

#include "farlod/error.hpp"
#include "tests/counted/held_memory.hpp"

namespace farlod::acceptance {
using testing::HasSubstr;

Outcome WorkFolder::run(const std::string& command) const {
  std::string line = "cd '" + folder_.path().string() + "' && PATH='" + FARLOD_BIN_DIR + "':\"$PATH\" && export PATH && ( ";
  line.append(command).append(" ) > .out 2> .err");
  const int status = std::system(line.c_str());
  return {WEXITSTATUS(status), text_of(".out"), text_of(".err")};
}

void WorkFolder::must(const std::string& command) const {
  const Outcome outcome = run(command);
  ASSERT_EQ(outcome.exit_code, exit_done) << command << '\n' << outcome.err;
}

std::optional<double> WorkFolder::held_mib(const std::string& command) const {
  if (!HeldMemory::counts_malloc) {
    must(command);
    return {};
  }
  must("LD_PRELOAD='" FARLOD_HELD_MEMORY_LIBRARY "' FARLOD_HELD_MEMORY=.held " + command);
  const std::string bytes = text_of(".held");
  std::filesystem::remove(path(".held"));
  return std::stod(bytes) / 1048576.0;
}

void WorkFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream file(path(name), std::ios::binary);
  file << text;
  file.close();
  ASSERT_TRUE(file) << name;
}

std::string WorkFolder::text_of(const std::string& name) const { return scenes::text_of(path(name)); }

std::set<std::string> WorkFolder::colours_of(const std::string& name) const {
  static const std::regex colour(R"(rgb\(([0-9.]+)%, ?([0-9.]+)%, ?([0-9.]+)%\))");
  const std::string text = text_of(name);
  std::set<std::string> colours;
  for (std::sregex_iterator found(text.begin(), text.end(), colour); found != std::sregex_iterator(); ++found) {
    std::ostringstream hex;
    hex << '#' << std::hex << std::setfill('0');
    for (const int part : {1, 2, 3}) hex << std::setw(2) << std::lround(std::stod((*found)[part]) * 2.55);
    colours.insert(hex.str());
  }
  return colours;
}

std::vector<std::string> WorkFolder::names() const {
  std::vector<std::string> names = folder_.names();
  std::erase_if(names, [](const std::string& name) { return name == ".out" || name == ".err"; });
  std::sort(names.begin(), names.end());
  return names;
}

nlohmann::json WorkFolder::json_of(const std::string& name) const { return nlohmann::json::parse(text_of(name)); }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void expect_refusal(const Outcome& outcome, int exit_code, const std::vector<std::string>& said) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_EQ(lines.size(), 1U) << outcome.err;
  for (const std::string& part : said) EXPECT_THAT(lines[0], HasSubstr(part));
  if (exit_code == exit_usage) {
    EXPECT_THAT(lines[0], HasSubstr("--help tells all options."));
  }
}

}  // namespace farlod::acceptance
