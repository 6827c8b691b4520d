// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/quantity_table.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace farlod {
namespace {

Quantities all_quantities() {
  Quantities all;
  for (const QuantityRow& row : quantity_table()) row.ask(all);
  return all;
}

TEST(QuantityTable, AsksForOneQuantityByItsWord) {
  for (const QuantityRow& row : quantity_table()) {
    Quantities one;
    EXPECT_FALSE(row.is_asked(one)) << row.word.word;
    EXPECT_TRUE(ask_for(row.word.word, one)) << row.word.word;
    EXPECT_TRUE(row.is_asked(one)) << row.word.word;
    EXPECT_GT(range_of(row.quantity, one).count, 0U) << row.word.word;
    EXPECT_EQ(one.any_of_canopies(), row.word.is_of_crowns) << row.word.word;
    // Distances are those of horizons, and trees take of hours of sunshine
    const std::map<Quantity, Quantity> with_another{{Quantity::horizon_distance, Quantity::horizon},
                                                    {Quantity::sunlit_total, Quantity::sunlit}};
    for (const QuantityRow& other : quantity_table()) {
      const auto besides = with_another.find(row.quantity);
      const bool is_besides = besides != with_another.end() && besides->second == other.quantity;
      EXPECT_EQ(other.is_asked(one), other.quantity == row.quantity || is_besides) << row.word.word << ' ' << other.word.word;
    }
  }
  Quantities none;
  EXPECT_FALSE(ask_for("svf_cubic", none));
  EXPECT_FALSE(none.any());
}

TEST(QuantityTable, ColumnsOfItsRowsFollowEachOther) {
  const Quantities all = all_quantities();
  std::size_t next = 0;
  for (const QuantityRow& row : quantity_table()) {
    const ColumnRange range = range_of(row.quantity, all);
    EXPECT_EQ(range.first, next) << row.word.word;
    next += range.count;
  }
  EXPECT_EQ(columns_of(all).size(), next);
  const ColumnRange crowns = range_of_crowns(all);
  EXPECT_EQ(crowns.first, range_of(Quantity::svf_total, all).first);
  EXPECT_EQ(crowns.first + crowns.count, next);
}

TEST(QuantityTable, DescribesEachColumnOnce) {
  std::set<std::string> names;
  for (const ColumnDescription& column : column_descriptions_of(all_quantities())) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_FALSE(column.unit.empty()) << column.name;
    EXPECT_FALSE(column.definition.empty()) << column.name;
  }
}

TEST(QuantityTable, TellsTheWordsOfWhatIsAskedFor) {
  EXPECT_EQ(words_of(all_quantities()).size(), quantity_words().size());
  EXPECT_TRUE(words_of({}).empty());
  Quantities two;
  two.sky_shares = two.hidden = true;
  EXPECT_EQ(words_of(two).at(0).word, "hidden");
  EXPECT_EQ(words_of(two).at(1).word, "shares");
}

TEST(QuantityTable, KeepsTheNumbersThatAreChosen) {
  Quantities chosen{.horizons = 12, .sky_patches = SkyPatchSet::reinhart};
  EXPECT_TRUE(ask_for("horizon_distance", chosen));
  EXPECT_TRUE(ask_for("sky_patches", chosen));
  EXPECT_EQ(range_of(Quantity::horizon_distance, chosen).count, 12U);
  EXPECT_EQ(range_of(Quantity::sky_patches, chosen).count, 577U);
}

TEST(QuantityTable, BoundsStandBehindTheTotal) {
  Quantities q{.svf_total = true};
  EXPECT_EQ(total_columns_of(q).total, 0U);
  EXPECT_FALSE(total_columns_of(q).low);
  q.svf_total_bounds = true;
  EXPECT_EQ(total_columns_of(q).low, 1U);
  EXPECT_THAT(columns_of(q), testing::ElementsAre("svf_total", "svf_total_low", "svf_total_high", "svfveg"));
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(FARLOD_SOURCE_DIR "/" + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the first group of a pattern matches, in the order of the text.
std::vector<std::string> matches_in(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> matches;
  for (std::sregex_iterator m(text.begin(), text.end(), expression), end; m != end; ++m) matches.push_back((*m)[1]);
  return matches;
}

std::vector<std::string> known_words() {
  std::vector<std::string> words;
  for (const QuantityWord& known : quantity_words()) words.emplace_back(known.word);
  return words;
}

TEST(QuantityTable, IsTheDocumentedOne) {
  const std::string page = text_of_file("docs/stages/evaluate.md"), head = "\n| `--quantity` |";
  const std::size_t begin = page.find(head);
  ASSERT_NE(begin, std::string::npos);
  const std::string table = page.substr(begin + head.size(), page.find("\n\n", begin) - begin - head.size());
  std::vector<std::string> words = known_words();
  words.insert(words.begin(), "svf");
  EXPECT_EQ(matches_in(table, "\n\\| `(\\w+)`"), words);
}

/// Tables have no place for units but the names of columns, and scripts rely on the names that are without.
TEST(QuantityTable, AUnitThatIsInNoNameIsDocumented) {
  const std::string page = text_of_file("docs/stages/results.md");
  const std::size_t begin = page.find("Units are in the column names");
  ASSERT_NE(begin, std::string::npos);
  const std::string units = page.substr(begin, page.find("\n\n", begin) - begin);
  for (const ColumnDescription& column : column_descriptions_of(all_quantities())) {
    if (column.unit == "1" || column.name.ends_with("_h")) continue;
    const std::string prefix = column.name.substr(0, column.name.find('_'));
    EXPECT_THAT(matches_in(units, "`(" + prefix + "(?:_?…)?)`"), testing::SizeIs(1)) << column.name;
  }
}

/// Hours of sunshine begin and end with days, which differ from those of the clock.
TEST(QuantityTable, HoursOfSunshineSayWhoseDaysTheyAreOf) {
  std::size_t hours = 0;
  for (const ColumnDescription& column : column_descriptions_of(all_quantities())) {
    if (column.unit != "h") continue;
    EXPECT_THAT(column.definition, testing::HasSubstr("local mean time")) << column.name;
    ++hours;
  }
  EXPECT_GT(hours, 0U);
}

TEST(QuantityTable, IsTheListOfThePlugInOfQgis) {
  const std::vector<std::string> lists = matches_in(text_of_file("qgis/farlod/evaluation.py"), "\nQUANTITIES = \\[([^\\]]*)\\]");
  ASSERT_EQ(lists.size(), 1U);
  EXPECT_EQ(matches_in(lists[0], "\"(\\w+)\""), known_words());
}

TEST(QuantityTable, HasOneFunctionThatComputesInEachRow) {
  for (const QuantityRow& row : quantity_table()) {
    EXPECT_EQ(row.add == nullptr, row.word.is_of_crowns) << row.word.word;
    EXPECT_EQ(row.add_of_crowns != nullptr, row.word.is_of_crowns) << row.word.word;
  }
}

}  // namespace
}  // namespace farlod
