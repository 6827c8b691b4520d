// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Manual pages and completions, as the build writes them from the options of the programs
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <regex>

#include "farlod/error.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/console/help_options.hpp"

namespace farlod::acceptance {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string documents = FARLOD_DOCUMENTS_DIR;

class DocumentsOf : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::string file(const std::string& ending) const { return documents + "/" + GetParam() + ending; }
  [[nodiscard]] std::string help() const { return folder.run(GetParam() + " --help").out; }
  [[nodiscard]] bool has_command(const std::string& name) const {
    return folder.run("command -v " + name).exit_code == exit_done;
  }
  void expect_no_complaint(const std::string& command) const {
    const Outcome outcome = folder.run(command);
    EXPECT_EQ(outcome.exit_code, exit_done) << command;
    EXPECT_EQ(outcome.out + outcome.err, "") << command;
  }

  /// What bash offers, sorted, for the last of the words that follow the program's name.
  [[nodiscard]] std::vector<std::string> completed(const std::vector<std::string>& words) const {
    std::string line = "COMP_WORDS=(" + GetParam();
    for (const std::string& word : words) line.append(" '").append(word).append("'");
    folder.write("complete.bash", "source '" + file(".bash") + "'\n" + line + ")\nCOMP_CWORD=" + std::to_string(words.size()) +
                                      "\n" + std::regex_replace("_" + GetParam(), std::regex("-"), "_") +
                                      "\n((${#COMPREPLY[@]} == 0)) || printf '%s\\n' \"${COMPREPLY[@]}\" | sort\n");
    const Outcome outcome = folder.run("bash complete.bash");
    EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return lines_of(outcome.out);
  }

  WorkFolder folder;
};

/// Pages are made where help2man was found.
class PageOf : public DocumentsOf {
 protected:
  void SetUp() override {
    if (!has_command("help2man")) GTEST_SKIP() << "help2man is not installed";
  }
  [[nodiscard]] std::string page() const { return folder.run("cat " + file(".1")).out; }
};

TEST_P(PageOf, ExplainsEachOptionOfHelp) {
  ASSERT_GE(test::options_in(help()).size(), 9U);
  for (const std::string& option : test::options_in(help())) {
    // A line that begins with it, perhaps after a short name: where it is explained, not where it is mentioned
    EXPECT_THAT(page(), testing::ContainsRegex("\n.TP\n(.fB.-[a-z].fR, )?.fB" +
                                               std::regex_replace(option, std::regex("-"), ".-") + ".fR"))
        << option;
  }
}

TEST_P(PageOf, HasTheUsualSections) {
  std::vector<std::string> sections;
  for (const std::string& line : lines_of(page()))
    if (line.starts_with(".SH ")) sections.push_back(line.substr(4));
  EXPECT_THAT(sections, ElementsAre("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "\"EXIT STATUS\"", "EXAMPLES", "COPYRIGHT",
                                    "\"SEE ALSO\""));
  EXPECT_THAT(page(), testing::ContainsRegex("\n.SH NAME\n" + GetParam() + " .- [a-z]"));
  EXPECT_THAT(page(), HasSubstr("\n.SH \"EXIT STATUS\"\n.TP\n0\ndone\n.TP\n1\nan internal error\n"));
  EXPECT_THAT(page(),
              testing::ContainsRegex("\n.SH EXAMPLES\n.IP\n.*[$] " + std::regex_replace(GetParam(), std::regex("-"), ".-")));
}

TEST_P(DocumentsOf, EachOptionOfHelpIsInTheCompletions) {
  const std::string zsh = folder.run("cat " + file(".zsh")).out;
  const std::vector<std::string> offered = completed({"--"});
  ASSERT_GE(test::options_in(help()).size(), 9U);
  for (const std::string& option : test::options_in(help())) {
    EXPECT_THAT(offered, Contains(option));
    EXPECT_THAT(zsh, testing::ContainsRegex("[' )]" + option + "=?\\["));
  }
  EXPECT_EQ(offered.size(), test::options_in(help()).size()) << "and nothing else";
}

TEST_P(DocumentsOf, BashCompletesChoices) {
  static const std::regex choices(" (--[a-z-]+) TEXT:\\{([^}]*)\\}");
  const std::string text = help();
  const std::ptrdiff_t count = std::distance(std::sregex_iterator(text.begin(), text.end(), choices), {});
  if (GetParam() == "farlod-pack" || GetParam() == "farlod-svf") {
    EXPECT_GE(count, 4) << "does help show choices otherwise now?";
  }
  for (std::sregex_iterator match(text.begin(), text.end(), choices), end; match != end; ++match) {
    std::vector<std::string> expected = lines_of(std::regex_replace(match->str(2), std::regex(","), "\n"));
    std::ranges::sort(expected);
    EXPECT_EQ(completed({match->str(1), ""}), expected) << match->str(1);
    EXPECT_THAT(completed({match->str(1), "=", expected.front()}), ElementsAre(expected.front()));
    EXPECT_EQ(completed({match->str(1), "="}), expected);
  }
}

TEST_P(DocumentsOf, BashCompletesFilesAndFoldersWhereHelpSaysSo) {
  folder.must("mkdir 'some town.farlod' && touch 'some points.csv'");
  static const std::regex values(" (--[a-z-]+) (FILE|FOLDER|TEXT|FLOAT|U?INT)[ =:]");
  const std::string text = help();
  EXPECT_GT(std::distance(std::sregex_iterator(text.begin(), text.end(), values), {}), 5)
      << "does help show values otherwise now?";
  for (std::sregex_iterator match(text.begin(), text.end(), values), end; match != end; ++match) {
    const std::vector<std::string> offered = completed({match->str(1), "some"});
    if (match->str(2) == "FILE")
      EXPECT_THAT(offered, ElementsAre("some points.csv", "some town.farlod")) << match->str(1);
    else if (match->str(2) == "FOLDER")
      EXPECT_THAT(offered, ElementsAre("some town.farlod")) << match->str(1);
    else
      EXPECT_THAT(offered, IsEmpty()) << match->str(1);
  }
}

TEST_P(DocumentsOf, BashCompletesArguments) {
  folder.must("mkdir town.farlod && touch town.gml");
  const std::map<std::string, std::vector<std::string>> expected{{"farlod-info", {"town.farlod"}},
                                                                 {"farlod-pack", {"town.farlod", "town.gml"}},
                                                                 {"farlod-svf", {"town.farlod"}},
                                                                 {"farlod-view", {"town.farlod"}}};
  EXPECT_EQ(completed({"--quiet", "town"}), expected.at(GetParam()));
}

TEST_P(DocumentsOf, ShellsReadTheCompletions) {
  expect_no_complaint("bash -n " + file(".bash"));
  if (!has_command("zsh")) GTEST_SKIP() << "zsh is not installed";
  expect_no_complaint("zsh -n " + file(".zsh"));
}

TEST_P(PageOf, IsReadByGroffAndMandoc) {
  if (!has_command("groff") || !has_command("mandoc")) GTEST_SKIP() << "groff or mandoc is not installed";
  expect_no_complaint("groff -K utf8 -man -ww -z " + file(".1"));
  // Of style it has nothing to say but that lines are long, and warns only of the date, which has no day
  expect_no_complaint("mandoc -T lint " + file(".1") + " | grep --invert-match --regexp 'STYLE: input text line longer' " +
                      "--regexp 'WARNING: cannot parse date' || true");
}

TEST_P(PageOf, IsShownByMan) {
  if (!has_command("man")) GTEST_SKIP() << "man is not installed";
  expect_no_complaint("man --warnings --encoding=UTF-8 --local-file -Tutf8 -Z " + file(".1") + " 2>&1 >/dev/null");
  const Outcome shown = folder.run("man --local-file " + file(".1") + " | col -bx");
  EXPECT_THAT(shown.out, HasSubstr("\nSYNOPSIS\n       " + GetParam() + " "));
  EXPECT_THAT(shown.out, HasSubstr("\n       --config FILE\n              Read options from this file: TOML, or the "));
}

TEST_P(PageOf, HasTheDateOfTheSources) {
  const std::string write = "'" FARLOD_SOURCE_DIR "/cmake/manual_page' \"$(command -v " + GetParam() + ")\" ";
  folder.must(write + "a.1 && " + write + "again.1 && cmp a.1 again.1");
  folder.must("SOURCE_DATE_EPOCH=86400 " + write + "b.1");
  EXPECT_THAT(folder.text_of("b.1"), HasSubstr(" \"1\" \"January 1970\" "));
}

const auto programs = testing::Values("farlod-info", "farlod-pack", "farlod-svf", "farlod-view");
const auto short_name = [](const auto& program) { return program.param.substr(std::string("farlod-").size()); };
INSTANTIATE_TEST_SUITE_P(Programs, DocumentsOf, programs, short_name);
INSTANTIATE_TEST_SUITE_P(Programs, PageOf, programs, short_name);

}  // namespace
}  // namespace farlod::acceptance
