// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/option_list.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "console/program_documents.hpp"
#include "tests/console/help_options.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A program with an option of each kind.
class OptionsOfAProgram : public testing::Test {
 protected:
  OptionsOfAProgram() {
    app.add_option("INPUT", texts, "Files")->required()->type_name(file_value);
    auto* place = app.add_option_group("Place", "Where");
    place->add_option("--here", text, "Here");
    place->add_option("--there", text, "There");
    place->require_option(1);
    app.add_option("-k,--kind", text, "Kind")->check(CLI::IsMember({"one", "two"}))->capture_default_str()->group("Group");
    app.add_option("--height", number, "Height")->check(between(0.5, 10.0))->group("Group");
    app.add_option("--count", integer, "Count")->check(between(-5, 10))->group("Group");
    app.add_option("--more", integer, "More")->check(CLI::PositiveNumber)->excludes("--count")->group("Group");
    app.add_flag("--flag", flag, "Flag")->group("Group");
    app.add_flag("--secret", flag, "Secret")->group("");
  }
  [[nodiscard]] OptionDescription option(const std::string& name) const {
    for (const OptionGroup& group : options_of(app).groups)
      for (const OptionDescription& each : group.options)
        if (each.names.back() == name) return each;
    return {};
  }

  CLI::App app;
  std::vector<std::string> texts;
  std::string text = "one";
  double number = 0.0;
  int integer = 0;
  bool flag = false;
};

TEST_F(OptionsOfAProgram, GroupOfWhichOneIsRequiredIsFirstAndHelpIsLast) {
  const OptionList list = options_of(app);
  ASSERT_EQ(list.groups.size(), 3U);
  EXPECT_EQ(list.groups[0].name, "Place");
  EXPECT_EQ(list.groups[0].text, "Where");
  EXPECT_TRUE(list.groups[0].exactly_one);
  EXPECT_EQ(list.groups[0].options.size(), 2U) << "without a --help of its own";
  EXPECT_FALSE(list.groups[1].exactly_one);
  EXPECT_EQ(list.groups[2].name, "Help");
  EXPECT_THAT(list.groups[2].options.at(0).names, ElementsAre("-h", "--help"));
}

TEST_F(OptionsOfAProgram, AnArgumentHasANameWithoutDashes) {
  const OptionList list = options_of(app);
  ASSERT_EQ(list.arguments.size(), 1U);
  EXPECT_THAT(list.arguments[0].names, ElementsAre("INPUT"));
  EXPECT_EQ(list.arguments[0].value, file_value);
  EXPECT_TRUE(list.arguments[0].required);
  EXPECT_TRUE(list.arguments[0].repeatable);
}

TEST_F(OptionsOfAProgram, ChoicesAndDefault) {
  EXPECT_THAT(option("--kind").names, ElementsAre("-k", "--kind"));
  EXPECT_THAT(option("--kind").choices, ElementsAre("one", "two"));
  EXPECT_EQ(option("--kind").standard, "one");
  EXPECT_EQ(option("--kind").text, "Kind");
  EXPECT_EQ(option("--kind").range, "");
}

TEST_F(OptionsOfAProgram, Ranges) {
  EXPECT_EQ(option("--height").range, "from 0.5 to 10");
  EXPECT_EQ(option("--height").value, "FLOAT");
  EXPECT_EQ(option("--count").range, "from -5 to 10");
  EXPECT_EQ(option("--more").range, "more than 0");
}

TEST_F(OptionsOfAProgram, WhatExcludesAnother) {
  EXPECT_THAT(option("--more").excluded, ElementsAre("--count"));
  EXPECT_THAT(option("--count").excluded, ElementsAre("--more"));
}

TEST_F(OptionsOfAProgram, AFlagHasNoValue) {
  EXPECT_EQ(option("--flag").value, "");
  EXPECT_EQ(option("--flag").standard, "");
}

TEST_F(OptionsOfAProgram, WhatHelpHidesIsHidden) { EXPECT_TRUE(option("--secret").names.empty()); }

OptionDescription option(std::vector<std::string> names, std::string value = "", std::vector<std::string> choices = {}) {
  OptionDescription option;
  option.names = std::move(names);
  option.value = std::move(value);
  option.choices = std::move(choices);
  option.text = "Text";
  return option;
}

OptionList list_of(std::vector<OptionDescription> options, std::vector<OptionDescription> arguments = {}) {
  return {std::move(arguments), {{"Group", "", false, std::move(options)}}};
}

// What the scripts do in a shell is tested with those of the programs, in tests/acceptance/documents_test.cpp

TEST(BashCompletion, OptionsWithTheSameValuesShareACase) {
  const std::string script =
      bash_completion("farlod-see", list_of({option({"-o", "--output"}, "FILE"), option({"--kind"}, "TEXT", {"a", "b"}),
                                             option({"--height"}, "FLOAT"), option({"--points"}, "FILE"), option({"--quiet"})}));
  EXPECT_THAT(script, HasSubstr("    -o | --output | --points)\n"));
  EXPECT_THAT(script, HasSubstr("compgen -W \"a b\" --"));
  EXPECT_THAT(script, HasSubstr("compgen -W \"-o --output --kind --height --points --quiet\" --"));
  EXPECT_THAT(script, HasSubstr("\ncomplete -F _farlod_see farlod-see\n"));
}

TEST(ZshCompletion, AnOptionComesWithItsText) {
  const std::string script = zsh_completion("farlod-see", list_of({option({"--quiet"}), option({"--height"}, "FLOAT")}));
  EXPECT_THAT(script, StartsWith("#compdef farlod-see\n"));
  EXPECT_THAT(script, HasSubstr("  '--quiet[Text]' \\\n  '--height=[Text]:FLOAT: '\n"));
}

TEST(ZshCompletion, TextIsQuoted) {
  OptionDescription odd = option({"--odd"}, "TEXT");
  odd.text = "X[,Y]: it's \\";
  EXPECT_THAT(zsh_completion("farlod-see", list_of({odd})), HasSubstr("'--odd=[X\\[,Y\\]\\: it'\\''s \\\\]:TEXT: '"));
}

TEST(ZshCompletion, NamesOfOneOptionExcludeEachOther) {
  EXPECT_THAT(zsh_completion("farlod-see", list_of({option({"-o", "--output"}, "FILE")})),
              HasSubstr("  '(--output)-o+[Text]:FILE:_files' \\\n  '(-o)--output=[Text]:FILE:_files'\n"));
}

TEST(ZshCompletion, OptionsOfWhichOneIsRequiredExcludeEachOther) {
  const OptionList list{{}, {{"Place", "", true, {option({"--here"}), option({"--there"})}}}};
  EXPECT_THAT(zsh_completion("farlod-see", list), HasSubstr("'(--there)--here[Text]' \\\n  '(--here)--there[Text]'\n"));
}

TEST(ZshCompletion, ArgumentsAreFilesOrFolders) {
  OptionDescription inputs = option({"INPUT"}, file_value);
  EXPECT_THAT(zsh_completion("farlod-see", list_of({}, {inputs})), HasSubstr("  '1:INPUT:_files'\n"));
  inputs.repeatable = true;
  EXPECT_THAT(zsh_completion("farlod-see", list_of({}, {inputs})), HasSubstr("  '*:INPUT:_files'\n"));
  EXPECT_THAT(zsh_completion("farlod-see", list_of({}, {option({"PACKAGE"}, folder_value)})),
              HasSubstr("  '1:PACKAGE:_files -/'\n"));
}

TEST(HelpOptions, AreTheLongNamesThatBeginALine) {
  const std::string help =
      "town — makes towns; see --size\n\nTry:\n  town -o a.obj --size 3\n\nOptions:\n  -h,--help   Print this\n"
      "  --size FLOAT:[1, 2]=1\n                --not-this\n  --to-centre   as --size\n[One of]\n    --in-a-group\n";
  EXPECT_EQ(test::options_in(help), (std::set<std::string>{"--help", "--in-a-group", "--size", "--to-centre"}));
}

}  // namespace
}  // namespace farlod
