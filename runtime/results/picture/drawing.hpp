// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "results/picture/picture.hpp"

namespace farlod {

/// A place of a drawing, in pixels of 1/96 inch from its upper left corner: x to the right, y downwards.
struct PagePoint {
  double x = 0.0, y = 0.0;
};

/// A polygon filled with a colour. The last corner is joined to the first.
struct Polygon {
  std::vector<PagePoint> corners;
  Colour colour;
};

/// A line through some places.
struct Line {
  std::vector<PagePoint> places;
  double width = 1.0;
  Colour colour;
  std::vector<double> dashes = {};  ///< lengths of what is drawn and what is left out, in turn; empty: all is drawn
};

/// A straight line from one place to another.
struct Segment {
  PagePoint a, b;
};

/// Many straight lines of one colour, which cost less than a Line each.
struct Segments {
  std::vector<Segment> segments;
  double width = 1.0;
  Colour colour;
};

/// The part of a segment that lies in an upright rectangle; empty where none does.
[[nodiscard]] std::optional<Segment> clipped(const Segment& segment, PagePoint upper_left, PagePoint lower_right);

using PageTriangle = std::array<PagePoint, 3>;

/// Visits the pixels of a picture whose middles a triangle covers; none of one that has no width.
void for_each_pixel(const PageTriangle& triangle, PixelSize picture, const std::function<void(Pixel)>& visit);

/// Where `Text::place` is along the line of text.
enum class Alignment : std::uint8_t { left, centre, right };

/// One line of text in UTF-8. `place` lies on its base line, `height` is the font's size in pixels.
struct Text {
  PagePoint place;
  std::string words;
  double height = 16.0;
  Alignment alignment = Alignment::left;
  Colour colour;
  std::optional<Colour> halo = std::nullopt;  ///< around the letters, so that they are read wherever they stand
};

/// An image whose pixels are those of the drawing.
struct Image {
  Pixel upper_left;
  Picture picture;
};

/// What a picture shows, whatever its file is. Later shapes hide earlier ones.
struct Drawing {
  PixelSize size;
  std::string title;  ///< of the document, which readers of screens and lists of files show
  Colour paper{255, 255, 255};
  std::vector<std::variant<Polygon, Line, Segments, Text, Image>> shapes = {};
};

/// An upright rectangle.
[[nodiscard]] inline Polygon box(PagePoint upper_left, double width, double height, Colour colour) {
  const auto [x, y] = upper_left;
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, colour};
}

/// A disc around a place, to the eye.
[[nodiscard]] Polygon disc(PagePoint middle, double radius, Colour colour);

/// A ring around something small, which is seen wherever it lies.
void add_ring(Drawing& drawing, PagePoint middle, double radius, Colour colour);

/// The longest edge of a drawing, in pixels.
inline constexpr std::size_t longest_drawing_edge = 32767;

/// Writes a drawing as PNG, SVG or PDF, by the ending of the path (in capitals or not). The same drawing gives the same bytes. A
/// path with another ending is a mistake of the caller. Throws OutputError.
void write_drawing(const Drawing& drawing, const std::filesystem::path& path);

/// What write_drawing holds in memory besides the drawing, of one with so many pixels; the images are no larger than that.
[[nodiscard]] constexpr std::uint64_t bytes_to_write_drawing(std::uint64_t pixels) { return pixels * 2 * sizeof(std::uint32_t); }

/// The bytes of a PNG file. Throws OutputError.
[[nodiscard]] std::string png_of(const Drawing& drawing);

/// The bytes of files that show a drawing: the functions of the module `farlod_cairo`. `path` is named in errors; nothing is
/// written. All throw OutputError.
struct DrawingFormats {
  using BytesOf = std::string (*)(const Drawing& drawing, const std::filesystem::path& path);
  BytesOf png, svg, pdf;
};

/// A length of 1, 2 or 5 times a power of ten, the longest that is not above `limit_m` (which is positive).
[[nodiscard]] double round_length_m(double limit_m);

/// A scale bar below a place, of 200 pixels at the most, and no wider than the map.
void add_scale_bar(Drawing& drawing, PagePoint place, double metres_per_pixel, std::size_t map_width);

/// An arrow that points upwards, with an N below it.
void add_north_arrow(Drawing& drawing, PagePoint tip);

}  // namespace farlod
