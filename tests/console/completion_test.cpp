// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/completion.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(script, testing::StartsWith("#compdef farlod-see\n"));
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

}  // namespace
}  // namespace farlod
