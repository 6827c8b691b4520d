// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

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
