// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/drawing.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "farlod/error.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr, testing::Not;

constexpr Colour white{255, 255, 255}, black{0, 0, 0}, red{200, 10, 20}, green{10, 150, 30};

/// One shape of each kind: an area, an image above it, a line and a text.
Drawing known_drawing() {
  Drawing drawing{{200, 100}, "Sky & <ground>"};
  drawing.shapes.emplace_back(box({10.0, 20.0}, 50.0, 30.0, red));
  Picture chequered({4, 2}, green);
  chequered.set({1, 0}, black);
  drawing.shapes.emplace_back(Image{{40, 30}, chequered});
  drawing.shapes.emplace_back(Line{{{100.0, 80.0}, {180.0, 80.0}}, 4.0, green});
  drawing.shapes.emplace_back(Text{{190.0, 40.0}, "0.82", 20.0, Alignment::right, black});
  return drawing;
}

std::string written(const Drawing& drawing, const std::string& name) {
  const scenes::TemporaryFolder folder;
  write_drawing(drawing, folder.file(name));
  EXPECT_THAT(folder.names(), testing::ElementsAre(name));
  return scenes::text_of(folder.file(name));
}

Picture drawn(const Drawing& drawing) {
  const scenes::TemporaryFolder folder;
  write_drawing(drawing, folder.file("a.png"));
  return decoded_png(folder.file("a.png"));
}

/// Pixels of a rectangle that are not white.
std::size_t inked(const Picture& picture, Pixel upper_left, Pixel end) {
  std::size_t count = 0;
  for (std::size_t y = upper_left.y; y < end.y; ++y)
    for (std::size_t x = upper_left.x; x < end.x; ++x) count += picture.at({x, y}) == white ? 0 : 1;
  return count;
}

std::size_t occurrences(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

TEST(Drawing, HasItsSizeAndItsColoursWhereTheyBelong) {
  const Picture picture = drawn(known_drawing());
  EXPECT_EQ(picture.size(), (PixelSize{200, 100}));
  EXPECT_EQ(picture.at({0, 0}), white);
  // The first and the last pixel of the area, and those beside them
  EXPECT_EQ(picture.at({10, 20}), red);
  EXPECT_EQ(picture.at({59, 49}), red);
  EXPECT_EQ(picture.at({9, 20}), white);
  EXPECT_EQ(picture.at({60, 49}), white);
  // The line is 4 pixels wide
  EXPECT_EQ(picture.at({140, 78}), green);
  EXPECT_EQ(picture.at({140, 81}), green);
  EXPECT_EQ(picture.at({140, 77}), white);
  EXPECT_EQ(picture.at({140, 82}), white);
}

TEST(Drawing, ImagesKeepTheirPixels) {
  const Picture picture = drawn(known_drawing());
  EXPECT_EQ(picture.at({40, 30}), green);
  EXPECT_EQ(picture.at({41, 30}), black);
  EXPECT_EQ(picture.at({42, 30}), green);
  EXPECT_EQ(picture.at({41, 31}), green);
  EXPECT_EQ(picture.at({44, 30}), red);
}

TEST(Drawing, TextEndsWhereItIsAlignedTo) {
  const Picture picture = drawn(known_drawing());
  // Digits stand on the base line and are .73 of the font's size high
  EXPECT_GT(inked(picture, {140, 25}, {191, 41}), 50U);
  EXPECT_EQ(inked(picture, {191, 0}, {200, 70}), 0U);
  EXPECT_EQ(inked(picture, {120, 41}, {200, 70}), 0U);
  Drawing left = known_drawing();
  std::get<Text>(left.shapes.back()).place.x = 130.0;
  std::get<Text>(left.shapes.back()).alignment = Alignment::left;
  EXPECT_EQ(inked(drawn(left), {100, 0}, {130, 70}), 0U);
  EXPECT_GT(inked(drawn(left), {130, 25}, {180, 41}), 50U);
}

TEST(Drawing, SvgHasTheSizeTheTitleAndALetterForEachCharacter) {
  const std::string svg = written(known_drawing(), "a.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"200px\" height=\"100px\""));
  EXPECT_THAT(svg, HasSubstr("<title>Sky &amp; &lt;ground></title>"));
  EXPECT_EQ(occurrences(svg, "<use xlink:href=\"#glyph"), 4U);
  Drawing without = known_drawing();
  without.shapes.pop_back();
  EXPECT_EQ(occurrences(written(without, "a.svg"), "<use xlink:href=\"#glyph"), 0U);
}

TEST(Drawing, PdfHasItsSizeInPointsAndItsTitle) {
  const std::string pdf = written(known_drawing(), "a.PDF");
  EXPECT_THAT(pdf, testing::StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 150 75 ]"));
  EXPECT_THAT(pdf, HasSubstr("/Title (Sky & <ground>)"));
  EXPECT_THAT(pdf, Not(HasSubstr("/CreationDate")));
}

TEST(Drawing, TheSameDrawingGivesTheSameBytes) {
  for (const char* name : {"a.png", "a.svg", "a.pdf"})
    EXPECT_EQ(written(known_drawing(), name), written(known_drawing(), name)) << name;
}

TEST(Drawing, LeavesNothingBehindOnFailure) {
  for (const std::string name : {"a.png", "a.svg", "a.pdf"}) {
    const scenes::TemporaryFolder folder;
    std::filesystem::create_directories(folder.file(name) / "inside");
    EXPECT_THROW(write_drawing(known_drawing(), folder.file(name)), OutputError) << name;
    EXPECT_THAT(folder.names(), testing::ElementsAre(name));
  }
}

TEST(Drawing, AnUnwritablePlaceIsNamedWithTheReason) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path path = folder.file("lost") / "a.pdf";
  try {
    write_drawing(known_drawing(), path);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string()));
    EXPECT_THAT(error.what(), HasSubstr("No such file"));
  }
}

TEST(Drawing, OnesThatAreTooLargeAreRefused) {
  const scenes::TemporaryFolder folder;
  EXPECT_THROW(write_drawing({{longest_drawing_edge + 1, 1}, "a"}, folder.file("a.png")), OutputError);
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

TEST(DrawingDeathTest, OtherEndingsAreAMistakeOfOurs) { EXPECT_DEATH(write_drawing(known_drawing(), "a.gif"), "ending == "); }

}  // namespace
}  // namespace farlod
