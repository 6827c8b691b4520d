// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/manual_page.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const ProgramDescription program{.name = "farlod-see",
                                 .purpose = "sees what farlod-pack made",
                                 .examples = {"farlod-see a -o b", "farlod-see 'c d'"},
                                 .background = {"Background."},
                                 .notes = {"Note."},
                                 .exit_codes = {{exit_done, "done"}, {exit_usage, "a wrong command line"}},
                                 .see_also = {"farlod-city", "farlod-pack"},
                                 .licence = "Apache-2.0"};

OptionDescription page_option(std::vector<std::string> names, std::string value = "") {
  OptionDescription page_option;
  page_option.names = std::move(names);
  page_option.value = std::move(value);
  page_option.text = "Text";
  return page_option;
}

std::string page_of(const OptionList& list, const std::string& date = "") { return manual_page(program, list, {"1.2.3", date}); }

TEST(ManualPage, BeginsWithTitleAndName) {
  EXPECT_THAT(page_of({}), StartsWith(".TH FARLOD\\-SEE 1 \"\" \"Far\\-LoD 1.2.3\" \"Far\\-LoD manual\"\n"));
  EXPECT_THAT(page_of({}), HasSubstr("\n.SH NAME\nfarlod\\-see \\- sees what farlod\\-pack made\n.SH SYNOPSIS\n"));
  EXPECT_THAT(page_of({}, "2001-02-03"), StartsWith(".TH FARLOD\\-SEE 1 \"2001-02-03\" "));
}

TEST(ManualPage, HasTheSectionsInTheirUsualOrder) {
  const std::string page = page_of({});
  std::size_t at = 0;
  for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "COPYRIGHT", "SEE ALSO"}) {
    const std::size_t found = page.find(std::string(".SH ") + section + "\n", at);
    ASSERT_NE(found, std::string::npos) << section;
    at = found;
  }
}

TEST(ManualPage, SynopsisShowsWhatMustBeGiven) {
  OptionDescription input = page_option({"INPUT"}, "FILE"), output = page_option({"-o", "--output"}, "FILE");
  input.repeatable = output.required = true;
  const OptionGroup place{"Place", "", true, {page_option({"--here"}, "TEXT"), page_option({"--there"})}};
  const OptionGroup rest{"Rest", "", false, {output, page_option({"--quiet"})}};
  EXPECT_THAT(page_of({{input}, {place, rest}}),
              HasSubstr(".SY farlod\\-see\n[\\fIINPUT\\fR...]\n{\\fB\\-\\-here\\fR\\ \\fITEXT\\fR |\n\\fB\\-\\-there\\fR}\n"
                        "\\fB\\-o\\fR\\ \\fIFILE\\fR\n[\\fIOPTION\\fR]...\n.YS\n"));
}

TEST(ManualPage, AnOptionIsExplainedAsInHelp) {
  OptionDescription full = page_option({"-k", "--kind"}, "TEXT");
  full.text = "a: the first; b: the other";
  full.choices = {"a", "b"};
  full.standard = "a";
  full.required = true;
  full.excluded = {"--less"};
  EXPECT_THAT(
      page_of({{}, {{"Group", "", false, {full}}}}),
      HasSubstr(".SS Group\n.TP\n\\fB\\-k\\fR, \\fB\\-\\-kind\\fR \\fITEXT\\fR\na: the first; b: the other.\nOne of a, b.\n"
                "Default: a.\nRequired.\nNot together with \\fB\\-\\-less\\fR.\n"));
  OptionDescription number = page_option({"--height"}, "FLOAT");
  number.range = "from 0 to 10";
  EXPECT_THAT(page_of({{}, {{"Group", "", false, {number}}}}), HasSubstr("Text.\nFrom 0 to 10.\n"));
}

TEST(ManualPage, AGroupSaysItsRule) {
  EXPECT_THAT(page_of({{}, {{"Place", "Where", true, {page_option({"--here"})}}}}),
              HasSubstr(".SS Place\nWhere.\nExactly one of these options is required.\n.TP\n"));
  EXPECT_THAT(page_of({{}, {{"Place", "", false, {page_option({"--here"})}}}}), HasSubstr(".SS Place\n.TP\n"));
}

TEST(ManualPage, EndsWithCodesExamplesAndOtherPrograms) {
  const std::string page = page_of({});
  EXPECT_THAT(page, HasSubstr(".SH EXIT STATUS\n.TP\n0\nDone.\n.TP\n2\nA wrong command line.\n"));
  EXPECT_THAT(page, HasSubstr("farlod\\-see a \\-o b\n"));
  EXPECT_THAT(page, HasSubstr("farlod\\-see \\(aqc d\\(aq\n"));
  EXPECT_THAT(page, HasSubstr("Licence: Apache-2.0.\n"));
  EXPECT_THAT(page, HasSubstr(".SH SEE ALSO\n.BR farlod\\-city (1),\n.BR farlod\\-pack (1)\n"));
  EXPECT_THAT(page, Not(HasSubstr("—")));
}

}  // namespace
}  // namespace farlod
