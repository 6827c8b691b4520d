// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace farlod {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::SizeIs;

const std::string authors = " SPDX-FileCopyrightText: The Far-LoD authors";
const std::string apache = " SPDX-License-Identifier: Apache-2.0";
const std::string gpl = " SPDX-License-Identifier: GPL-3.0-or-later";

struct Rule {
  const char* name;
  std::vector<std::string> (*breaches)(const std::vector<SourceFile>& tree);
};
class ThisTree : public testing::TestWithParam<Rule> {};
TEST_P(ThisTree, KeepsTheRule) { EXPECT_THAT(GetParam().breaches(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty()); }
INSTANTIATE_TEST_SUITE_P(HouseRules, ThisTree,
                         testing::Values(Rule{"EachFileNamesItsLicence", files_without_licence},
                                         Rule{"NoFileIsTooLong", files_too_long}, Rule{"NoFunctionIsTooLong", functions_too_long},
                                         Rule{"FileNamesSayWhatIsInside", files_with_empty_names},
                                         Rule{"NothingIsLeftForLater", files_with_notes_to_self},
                                         Rule{"EachTestWritesInAFolderOfItsOwn", tests_without_own_folder},
                                         Rule{"NoTestDependsOnTheMachine", tests_that_depend_on_the_machine},
                                         Rule{"EachExcuseExcusesSomething", useless_excuses},
                                         Rule{"CommentsSayTheirSubjectFirst", comments_without_subject}),
                         [](const auto& test) { return test.param.name; });

TEST(HouseRules, PythonIsCode) {
  const std::vector<SourceFile> tree = read_source_tree(FARLOD_SOURCE_DIR);
  EXPECT_THAT(tree, Contains(Field(&SourceFile::path, "qgis/farlod/provider.py")));
}

TEST(HouseRules, LinesOfDocumentsFitAScreen) {
  const std::vector<SourceFile> documents = read_documents(FARLOD_SOURCE_DIR);
  ASSERT_GT(documents.size(), 30U) << "the documents were not found at " << FARLOD_SOURCE_DIR;
  EXPECT_THAT(prose_lines_too_long(documents), IsEmpty());
}

TEST(HouseRules, AMissingOrWrongLicenceIsFound) {
  EXPECT_THAT(files_without_licence({{"runtime/good.cpp", {"//" + authors, "//" + apache}},
                                     {"preprocess/good.cpp", {"//" + authors, "//" + gpl}},
                                     {"qgis/good.py", {"#" + authors, "#" + gpl}},
                                     {"scripts/good", {"#!/usr/bin/env bash", "#" + authors, "#" + apache}},
                                     {"runtime/gpl.cpp", {"//" + authors, "//" + gpl}},
                                     {"preprocess/apache.cpp", {"//" + authors, "//" + apache}},
                                     {"runtime/late.cpp", {"#pragma once", "//" + authors, "//" + apache}},
                                     {"runtime/empty.cpp", {}},
                                     {"qgis/apache.py", {"#" + authors, "#" + apache}},
                                     {"tests/gpl.py", {"#" + authors, "#" + gpl}}}),
              ElementsAre("runtime/gpl.cpp", "preprocess/apache.cpp", "runtime/late.cpp", "runtime/empty.cpp", "qgis/apache.py",
                          "tests/gpl.py"));
}

TEST(HouseRules, ALongFileIsFound) {
  EXPECT_THAT(files_too_long({{"a.cpp", std::vector<std::string>(400)},
                              {"b.cpp", std::vector<std::string>(401)},
                              {"c.ts", std::vector<std::string>(401)}}),
              ElementsAre("b.cpp", "c.ts"));
}

/// A file whose lines are `before`, `lines` statements, a comment, a blank line and `after`.
SourceFile file_with(const std::string& path, std::vector<std::string> before, std::size_t lines, const std::string& after) {
  for (std::size_t n = 0; n < lines; ++n) before.push_back(after.substr(0, after.find('}')) + "  call();");
  before.insert(before.end(), {"  // why", "", after});
  return {path, before};
}

TEST(HouseRules, ALongFunctionIsFound) {
  const std::vector<std::string> plain{"int f(int a) {"},
      wrapped{"", "std::vector<int> C::f(int a,", "                      int b) const {"},
      constructor{"C::C(int a)", "    : a_(a) {"}, member{"class C {", "  int g() {"}, not_one{"constexpr int a[] = {"};
  EXPECT_THAT(
      functions_too_long({file_with("a.cpp", plain, 25, "}"), file_with("b.cpp", plain, 26, "}"),
                          file_with("c.cpp", wrapped, 26, "}"), file_with("d.cpp", constructor, 26, "}"),
                          file_with("e.hpp", member, 26, "  }"), file_with("f.cpp", not_one, 26, "};"),
                          file_with("tests/g.cpp", plain, 26, "}")}),
      ElementsAre("b.cpp:1 f has 26 lines", "c.cpp:2 f has 26 lines", "d.cpp:1 C has 26 lines", "e.hpp:2 g has 26 lines"));
}

TEST(HouseRules, AnExcuseForNothingIsFound) {
  const std::string clock = std::string("steady_") + "clock";
  const std::string function = "package/horizon_edge.hpp", test = "tests/reliability/soak.cpp";
  const std::vector<std::string> kernel{"bool may_be_silhouette(int a) {"}, renamed{"void trace(int a) {"};
  const std::string excuse = function + " may_be_silhouette";
  EXPECT_THAT(useless_excuses({}), IsSupersetOf({excuse, test, std::string("tests/scenes/temporary_folder.hpp")}));
  EXPECT_THAT(useless_excuses({file_with(function, kernel, 26, "}")}), Not(Contains(excuse)));
  EXPECT_THAT(useless_excuses({file_with(function, kernel, 25, "}")}), Contains(excuse));
  EXPECT_THAT(useless_excuses({file_with(function, renamed, 26, "}")}), Contains(excuse));
  EXPECT_THAT(useless_excuses({{test, {"std::chrono::" + clock + "::now();"}}}), Not(Contains(test)));
  EXPECT_THAT(useless_excuses({{test, {"const CountedSteps steps;"}}}), Contains(test));
}

TEST(HouseRules, ACommentWithoutASubjectIsFound) {
  EXPECT_THAT(comments_without_subject({{"base/a.hpp", {"/// Of a cell.", "/// The edge.", "int a;  ///< Of it."}},
                                        {"preprocess/tiles/b.cpp", {"  //Of two", "  // Often", "  // one", "  // of two"}},
                                        {"tests/c.hpp", {"/// Of a cell."}},
                                        {"preprocess/d.py", {"# Of a cell."}}}),
              ElementsAre("base/a.hpp:1", "base/a.hpp:3", "preprocess/tiles/b.cpp:1"));
}

TEST(HouseRules, ALongLineOfProseIsFound) {
  std::string dashes;
  for (int n = 0; n < 120; ++n) dashes += "–";
  EXPECT_THAT(prose_lines_too_long({{"a.md", {std::string(120, 'a'), std::string(121, 'a'), dashes, dashes + "a"}},
                                    {"b.md", {"| " + std::string(200, 'a') + " |", "", "* " + std::string(119, 'a')}}}),
              ElementsAre("a.md:2 has 121 characters", "a.md:4 has 121 characters", "b.md:3 has 121 characters"));
}

TEST(HouseRules, AnEmptyNameIsFound) {
  EXPECT_THAT(
      files_with_empty_names(
          {{"runtime/utils.hpp", {}}, {"runtime/grid_helpers.cpp", {}}, {"runtime/common/a.cpp", {}}, {"runtime/grid.cpp", {}}}),
      ElementsAre("runtime/utils.hpp", "runtime/grid_helpers.cpp", "runtime/common/a.cpp"));
}

TEST(HouseRules, ANoteToSelfIsFound) {
  const std::string word = std::string("TO") + "DO";
  EXPECT_THAT(files_with_notes_to_self({{"a.cpp", {"// " + word + ": later"}}, {"b.cpp", {"// done"}}}), ElementsAre("a.cpp"));
}

TEST(HouseRules, ATestInASharedFolderIsFound) {
  const std::string shared = std::string("testing::Temp") + "Dir()";
  EXPECT_THAT(tests_without_own_folder({{"tests/a.cpp", {"  auto file = " + shared + " / \"a\";"}},
                                        {"tests/b.cpp", {"  scenes::TemporaryFolder folder;"}},
                                        {"runtime/c.cpp", {"  " + shared}}}),
              ElementsAre("tests/a.cpp"));
}

TEST(HouseRules, ATestThatMeasuresTimeOrMemoryIsFound) {
  const std::string clock = std::string("steady_") + "clock", resident = std::string("Vm") + "HWM";
  EXPECT_THAT(tests_that_depend_on_the_machine({{"tests/a.cpp", {"  const auto begin = std::chrono::" + clock + "::now();"}},
                                                {"tests/b.cpp", {"  const CountedSteps steps;"}},
                                                {"tests/c.cpp", {"  if (line.starts_with(\"" + resident + ":\"))"}},
                                                {"runtime/d.cpp", {"  std::chrono::" + clock + "::now();"}}}),
              ElementsAre("tests/a.cpp", "tests/c.cpp"));
}

std::string text_of(const std::string& path) {
  std::ifstream file(std::filesystem::path(FARLOD_SOURCE_DIR) / path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The parts of a text that an expression has between its brackets, match by match.
std::vector<std::vector<std::string>> matches_in(const std::string& text, const std::regex& expression) {
  std::vector<std::vector<std::string>> found;
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    found.emplace_back(match->begin() + 1, match->end());
  return found;
}

/// Hosts compare the whole file with the texts that they know: a line of our own would make it unknown.
TEST(LicenceTexts, TheOneAtTheRootIsApaches) {
  const std::string text = text_of("LICENSE");
  EXPECT_THAT(text, HasSubstr("Apache License"));
  EXPECT_EQ(text, text_of("LICENSES/Apache-2.0.txt"));
}

/// A list of licences means that the reader may choose one.
TEST(LicenceTexts, TheCitationHasOneLicence) {
  const std::string citation = text_of("CITATION.cff");
  EXPECT_THAT(matches_in(citation, std::regex(R"(\nlicense: ([\w.-]+)\n)")), SizeIs(1));
}

/// The page of farlod-view contains libraries, which its bundle lists with their licences.
TEST(LicenceTexts, DebiansCopyrightNamesTheLibrariesOfThePage) {
  const std::string bundle = text_of("viewer/bundle/licences.txt"), copyright = text_of("packaging/debian/copyright");
  const auto libraries = matches_in(bundle, std::regex(R"(\n  (\S+) ([\d.]+) \((\S+)\))"));
  const auto owners = matches_in(bundle, std::regex(R"(\n *Copyright (?:© |\(c\) )?(\d{4}\S* [^\n]+))"));
  ASSERT_THAT(libraries, SizeIs(testing::Ge(3U)));
  ASSERT_THAT(owners, SizeIs(libraries.size()));
  for (const auto& library : libraries) {
    // Debian calls the MIT licence by the name of its text
    const std::string licence = library[2] == "MIT" ? "Expat" : library[2];
    EXPECT_THAT(copyright, HasSubstr(library[0] + " " + library[1] + " (" + licence + ")"));
    EXPECT_THAT(copyright, HasSubstr("\nLicense: " + licence + "\n"));
  }
  for (const auto& owner : owners) EXPECT_THAT(copyright, HasSubstr(owner[0]));
}

}  // namespace
}  // namespace farlod
