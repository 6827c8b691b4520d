// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "farlod/export.hpp"
#include "farlod/version.hpp"
#include "results/module.hpp"
#include "results/picture/drawing.hpp"

namespace farlod {
namespace {

// Debian's fonts-dejavu-core has it; where it is missing, fontconfig chooses another
constexpr const char* font_family = "DejaVu Sans";
constexpr double points_of_pixel = 72.0 / 96.0;

template <auto Release>
struct Releaser {
  template <class T>
  void operator()(T* object) const {
    Release(object);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Releaser<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Releaser<cairo_destroy>>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Releaser<cairo_font_options_destroy>>;
using FontDescription = std::unique_ptr<PangoFontDescription, Releaser<pango_font_description_free>>;
using Layout = std::unique_ptr<PangoLayout, Releaser<g_object_unref>>;

/// Cairo keeps the first error of an object, so that asking at the end is enough.
void require_success(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS) throw OutputError(path, cairo_status_to_string(status));
}

cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count) noexcept {
  try {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

/// The pixels of an image, as Cairo has them in memory. Ours, so that what pictures take is counted as all else is.
class PixelSurface {
 public:
  explicit PixelSurface(PixelSize size)
      : pixels_(size.width * size.height),
        surface_(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels_.data()), CAIRO_FORMAT_RGB24,
                                                     static_cast<int>(size.width), static_cast<int>(size.height),
                                                     static_cast<int>(size.width * sizeof(std::uint32_t)))) {}
  explicit PixelSurface(const Picture& picture) : PixelSurface(picture.size()) {
    std::transform(picture.pixels().begin(), picture.pixels().end(), pixels_.begin(),
                   [](Colour c) { return std::uint32_t{c.red} << 16U | std::uint32_t{c.green} << 8U | std::uint32_t{c.blue}; });
    cairo_surface_mark_dirty(surface_.get());
  }
  [[nodiscard]] cairo_surface_t* get() const { return surface_.get(); }

 private:
  std::vector<std::uint32_t> pixels_;
  Surface surface_;
};

void set_colour(cairo_t* context, Colour colour) {
  cairo_set_source_rgb(context, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

void set_path(cairo_t* context, const std::vector<PagePoint>& places) {
  cairo_new_path(context);
  for (const PagePoint p : places) cairo_line_to(context, p.x, p.y);
}

/// Draws the shapes on a surface, whose unit is a pixel of the drawing.
class Pen {
 public:
  explicit Pen(cairo_surface_t* surface) : context_(cairo_create(surface)) {}

  [[nodiscard]] cairo_t* get() const { return context_.get(); }

  void operator()(const Polygon& area) const {
    set_path(get(), area.corners);
    cairo_close_path(get());
    set_colour(get(), area.colour);
    cairo_fill(get());
  }
  void operator()(const Line& line) const {
    set_path(get(), line.places);
    set_colour(get(), line.colour);
    cairo_set_line_width(get(), line.width);
    cairo_set_line_join(get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(get(), line.dashes.data(), static_cast<int>(line.dashes.size()), 0.0);
    cairo_stroke(get());
    cairo_set_dash(get(), nullptr, 0, 0.0);
  }
  void operator()(const Segments& lines) const {
    // A path of all of them would take Cairo a time that grows with the square of their number
    constexpr std::size_t segments_of_path = 500;
    set_colour(get(), lines.colour);
    cairo_set_line_width(get(), lines.width);
    cairo_set_line_cap(get(), CAIRO_LINE_CAP_ROUND);
    cairo_new_path(get());
    for (std::size_t n = 0; n < lines.segments.size(); ++n) {
      const auto& [a, b] = lines.segments[n];
      cairo_move_to(get(), a.x, a.y);
      cairo_line_to(get(), b.x, b.y);
      if ((n + 1) % segments_of_path == 0) cairo_stroke(get());
    }
    cairo_stroke(get());
    cairo_set_line_cap(get(), CAIRO_LINE_CAP_BUTT);
  }
  void operator()(const Text& text) const {
    const Layout layout = layout_of(text);
    PangoLayoutLine* const line = pango_layout_get_line_readonly(layout.get(), 0);
    PangoRectangle extents;
    pango_layout_line_get_extents(line, nullptr, &extents);
    const double share = text.alignment == Alignment::left ? 0.0 : text.alignment == Alignment::centre ? 0.5 : 1.0;
    const double x = text.place.x - share * pango_units_to_double(extents.width);
    if (text.halo) draw_halo(line, {x, text.place.y}, *text.halo);
    cairo_move_to(get(), x, text.place.y);
    set_colour(get(), text.colour);
    pango_cairo_show_layout_line(get(), line);
    cairo_new_path(get());
  }
  void operator()(const Image& image) const {
    const PixelSurface pixels(image.picture);
    const auto x = static_cast<double>(image.upper_left.x), y = static_cast<double>(image.upper_left.y);
    cairo_set_source_surface(get(), pixels.get(), x, y);
    // Pixels stay squares, however large a reader draws them
    cairo_pattern_set_filter(cairo_get_source(get()), CAIRO_FILTER_NEAREST);
    cairo_rectangle(get(), x, y, static_cast<double>(image.picture.size().width),
                    static_cast<double>(image.picture.size().height));
    cairo_fill(get());
    // A document of vectors copies the pixels now, before they are gone
    set_colour(get(), {});
    cairo_surface_finish(pixels.get());
  }

 private:
  void draw_halo(PangoLayoutLine* line, PagePoint place, Colour colour) const {
    constexpr double halo_width = 3.0;
    cairo_move_to(get(), place.x, place.y);
    pango_cairo_layout_line_path(get(), line);
    set_colour(get(), colour);
    cairo_set_line_width(get(), halo_width);
    cairo_set_line_join(get(), CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(get());
  }

  /// The shapes of letters depend on the font alone, and not on what a user's settings say of screens.
  [[nodiscard]] Layout layout_of(const Text& text) const {
    const FontOptions options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    Layout layout(pango_cairo_create_layout(get()));
    pango_cairo_context_set_font_options(pango_layout_get_context(layout.get()), options.get());
    pango_context_set_round_glyph_positions(pango_layout_get_context(layout.get()), 0);
    pango_layout_context_changed(layout.get());
    const FontDescription font(pango_font_description_new());
    pango_font_description_set_family_static(font.get(), font_family);
    pango_font_description_set_absolute_size(font.get(), text.height * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_single_paragraph_mode(layout.get(), 1);
    pango_layout_set_text(layout.get(), text.words.data(), static_cast<int>(text.words.size()));
    return layout;
  }

  Context context_;
};

void draw(const Drawing& drawing, cairo_surface_t* surface, const std::filesystem::path& path, double scale = 1.0) {
  const Pen pen(surface);
  cairo_scale(pen.get(), scale, scale);
  pen(box({0.0, 0.0}, static_cast<double>(drawing.size.width), static_cast<double>(drawing.size.height), drawing.paper));
  for (const auto& shape : drawing.shapes) std::visit(pen, shape);
  require_success(cairo_status(pen.get()), path);
}

std::string png_of(const Drawing& drawing, const std::filesystem::path& path) {
  const PixelSurface pixels(drawing.size);
  draw(drawing, pixels.get(), path);
  cairo_surface_flush(pixels.get());
  std::string text;
  require_success(cairo_surface_write_to_png_stream(pixels.get(), append_bytes, &text), path);
  return text;
}

/// Ends a document of vectors.
void finish(cairo_surface_t* surface, const std::filesystem::path& path) {
  cairo_surface_finish(surface);
  require_success(cairo_surface_status(surface), path);
}

std::string pdf_of(const Drawing& drawing, const std::filesystem::path& path) {
  std::string text;
  const Surface surface(cairo_pdf_surface_create_for_stream(append_bytes, &text,
                                                            static_cast<double>(drawing.size.width) * points_of_pixel,
                                                            static_cast<double>(drawing.size.height) * points_of_pixel));
  // What later versions have, such as objects in compressed streams, is not needed
  cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, drawing.title.c_str());
  // No date: the same input gives the same bytes
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  draw(drawing, surface.get(), path, points_of_pixel);
  finish(surface.get(), path);
  return text;
}

std::string escaped(const std::string& words) {
  std::string text;
  for (const char c : words) text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return text;
}

/// Cairo counts the surfaces of a process, and names images and groups by these numbers: here they count from 1, in the order of
/// the text. Pixels in base 64 have neither quotes nor hashes.
std::string with_own_numbers(const std::string& text, const std::string& word) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  std::map<std::string, std::size_t> numbers;
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t found = text.find(word, at);
    if (found == std::string::npos) return result.append(text, at);
    const std::size_t first = found + word.size();
    std::size_t end = first;
    while (end < text.size() && is_digit(text[end])) ++end;
    result.append(text, at, first - at);
    const bool is_name = found > 0 && (text[found - 1] == '"' || text[found - 1] == '#') && end > first;
    if (is_name) result += std::to_string(numbers.try_emplace(text.substr(first, end - first), numbers.size() + 1).first->second);
    at = is_name ? end : first;
  }
  return result;
}

std::string svg_of(const Drawing& drawing, const std::filesystem::path& path) {
  std::string text;
  const Surface surface(cairo_svg_surface_create_for_stream(append_bytes, &text, static_cast<double>(drawing.size.width),
                                                            static_cast<double>(drawing.size.height)));
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  draw(drawing, surface.get(), path);
  finish(surface.get(), path);
  for (const char* const word : {"surface", "image", "source-"}) text = with_own_numbers(text, word);
  const std::size_t head = text.find("<svg");
  FARLOD_EXPECTS(head != std::string::npos);
  return text.insert(text.find('>', head) + 1, "\n<title>" + escaped(drawing.title) + "</title>");
}

constexpr DrawingFormats functions{.png = png_of, .svg = svg_of, .pdf = pdf_of};

}  // namespace
}  // namespace farlod

extern "C" FARLOD_EXPORT const farlod::ModuleEntry farlod_module{farlod::software_version, &farlod::functions};
