// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/drawing.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "results/picture/cell_picture.hpp"
#include "results/picture/picture.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  const std::string refusal = scenes::refusal_of<OutputError>([&] { write_drawing(known_drawing(), path); });
  EXPECT_THAT(refusal, HasSubstr(path.string()));
  EXPECT_THAT(refusal, HasSubstr("No such file"));
}

TEST(Drawing, OnesThatAreTooLargeAreRefused) {
  const scenes::TemporaryFolder folder;
  EXPECT_THROW(write_drawing({{longest_drawing_edge + 1, 1}, "a"}, folder.file("a.png")), OutputError);
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

TEST(DrawingDeathTest, OtherEndingsAreAMistakeOfOurs) { EXPECT_DEATH(write_drawing(known_drawing(), "a.gif"), "ending == "); }

// What readers see of our colours who lack one kind of cones, or who have a print in grey

using Channels = std::array<double, 3>;
using Matrix = std::array<Channels, 3>;

struct Vision {
  std::string name;
  Matrix matrix;
};

/// Machado, Oliveira and Fernandes (2009), severity 1, for linear sRGB; grey has the luminance of IEC 61966-2-1.
const std::array<Vision, 4> visions{
    Vision{"protanopia", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    Vision{"deuteranopia", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    Vision{"tritanopia", {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}},
    Vision{"grey", {{{0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}}}}};

double product(const Channels& a, const Channels& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// CIELAB (white D65) of a colour as somebody sees it: lightness, and the two axes of hue.
Channels lab_of(Colour colour, const Vision& vision) {
  const Channels rgb{linear_channel(colour.red), linear_channel(colour.green), linear_channel(colour.blue)};
  Channels seen{};
  for (std::size_t n = 0; n < 3; ++n) seen[n] = std::clamp(product(vision.matrix[n], rgb), 0.0, 1.0);
  constexpr Matrix xyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  constexpr Channels white{0.9505, 1.0, 1.089};
  Channels f{};
  for (std::size_t n = 0; n < 3; ++n) {
    const double t = product(xyz[n], seen) / white[n];
    f[n] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

/// CIE 1976.
double difference(Colour a, Colour b, const Vision& vision) {
  const Channels p = lab_of(a, vision), q = lab_of(b, vision);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(ColourVision, LightnessRisesWithTheShareForEverybody) {
  for (const Vision& vision : visions)
    for (int n = 1; n <= 50; ++n)
      EXPECT_GT(lab_of(colour_of_svf(n / 50.0), vision)[0], lab_of(colour_of_svf((n - 1) / 50.0), vision)[0])
          << vision.name << ' ' << n / 50.0;
}

TEST(ColourVision, ATenthIsSeenByEverybody) {
  // A difference of 2.3 is the least that is noticed side by side (Mahy, Van Eycken and Oosterlinck 1994)
  constexpr double noticed = 2.3;
  for (const Vision& vision : visions)
    for (int n = 1; n <= 10; ++n)
      EXPECT_GT(difference(colour_of_svf(n / 10.0), colour_of_svf((n - 1) / 10.0), vision), 2.0 * noticed)
          << vision.name << ' ' << n / 10.0;
}

TEST(ColourVision, LargerErrorsAreDarkerForEverybody) {
  for (const Vision& vision : visions)
    for (int n = 1; n <= 20; ++n)
      for (const double sign : {-1.0, 1.0})
        EXPECT_LT(lab_of(colour_of_error(sign * n / 20.0), vision)[0], lab_of(colour_of_error(sign * (n - 1) / 20.0), vision)[0])
            << vision.name << ' ' << sign * n / 20.0;
}

TEST(ColourVision, SignsOfErrorsAreToldApartByEverybodyButInGrey) {
  constexpr double clear = 10.0;
  for (const Vision& vision : visions)
    for (int n = 4; n <= 20 && vision.name != "grey"; ++n)
      EXPECT_GT(difference(colour_of_error(n / 20.0), colour_of_error(-n / 20.0), vision), clear)
          << vision.name << ' ' << n / 20.0;
}

TEST(ColourVision, ZonesOfACellAreToldApartByEverybody) {
  constexpr double clear = 10.0;
  for (const Vision& vision : visions)
    for (const auto& [a, b] :
         {std::pair{CellZone::cell, CellZone::near}, {CellZone::near, CellZone::far}, {CellZone::cell, CellZone::far}})
      EXPECT_GT(difference(building_colour(a), building_colour(b), vision), clear) << vision.name;
  for (const Vision& vision : visions)
    for (const CellZone zone : {CellZone::cell, CellZone::near, CellZone::far})
      EXPECT_GT(difference(building_colour(zone), street_colour(zone), vision), 2.0 * clear) << vision.name;
}

}  // namespace
}  // namespace farlod
