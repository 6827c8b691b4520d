// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/json_cursor.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace farlod {
namespace {

TEST(JsonCursor, ReadsWhatIsAskedForAndSkipsTheRest) {
  const std::string text = R"( { "a" : [1, -2.50, {"deep": ["}", "\"]"]}], "b" : true, "c":"x","d" : 7 } )";
  JsonCursor cursor(text);
  std::vector<std::string> names;
  std::vector<double> numbers;
  cursor.members([&](const std::string& name) {
    names.push_back(name);
    if (name == "a")
      cursor.elements([&](std::size_t k) {
        if (k < 2) numbers.push_back(cursor.number());
      });
    if (name == "d") {
      EXPECT_EQ(cursor.whole(), 7);
    }
  });
  EXPECT_EQ(cursor.peek(), '\0');
  EXPECT_THAT(names, testing::ElementsAre("a", "b", "c", "d"));
  EXPECT_THAT(numbers, testing::ElementsAre(1.0, -2.5));
}

TEST(JsonCursor, KnowsWhereValuesBeginAndEnd) {
  const std::string text = R"({ "a": {"b" : 1 , "c":"2"  } ,"d":{ }})";
  JsonCursor cursor(text);
  std::vector<JsonExtent> extents;
  cursor.members([&](const std::string&) { extents.push_back(cursor.members([](const std::string&) {})); });
  ASSERT_EQ(extents.size(), 2U);
  EXPECT_EQ(text.substr(extents[0].first, extents[0].last - extents[0].first), R"("b" : 1 , "c":"2")");
  EXPECT_TRUE(extents[1].is_empty());
  EXPECT_EQ(text.substr(extents[1].first), " }}");
}

TEST(JsonCursor, UnderstandsEscapes) {
  JsonCursor cursor(R"("\"\\\/\n\t\u0041\u00e9\u20ac\ud83c\udfe0 \u0000.")");
  EXPECT_EQ(cursor.string(), std::string("\"\\/\n\tA\u00e9\u20ac\U0001f3e0 \0.", 18));
}

TEST(JsonCursor, NumbersThatAreNotWholeAreNone) {
  for (const char* text : {"1.0", "1e3", "99999999999999999999"}) EXPECT_EQ(JsonCursor(text).whole(), std::nullopt) << text;
  EXPECT_EQ(JsonCursor("-12").whole(), -12);
}

TEST(JsonCursor, NestingNeedsNoStack) {
  constexpr std::size_t deep = 1'000'000;
  JsonCursor cursor("[]");
  const std::string text = std::string(deep, '[') + std::string(deep, ']');
  cursor = JsonCursor(text);
  cursor.skip();
  EXPECT_EQ(cursor.at(), text.size());
}

TEST(JsonCursor, RefusesWhatIsCutShortOrAnotherValue) {
  for (const char* text : {"", "{", "{\"a", "{\"a\"", "{\"a\":", "{\"a\":1", "{\"a\":1,", "{\"a\":[1", "{\"a\":\"\\",
                           "{\"a\":\"\\\"}", "[1]", "{1:2}", "{\"a\" 1}", "{\"a\\u12\":1}", "{\"a\\x\":1}"})
    EXPECT_THROW(JsonCursor(text).members([](const std::string&) {}), JsonCursorError) << text;
  EXPECT_THROW((void)JsonCursor("\"1\"").number(), JsonCursorError);
}

}  // namespace
}  // namespace farlod
