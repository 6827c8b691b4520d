// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <ostream>

#include "base/expects.hpp"
#include "base/lower_case.hpp"
#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/module.hpp"
#include "results/picture/drawing_formats.hpp"

namespace farlod {
namespace {

const DrawingFormats& drawing_formats() {
  static const auto& formats = *static_cast<const DrawingFormats*>(functions_of_module("farlod_cairo", "Cairo and Pango"));
  return formats;
}

}  // namespace

void write_drawing(const Drawing& drawing, const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  FARLOD_EXPECTS(ending == ".png" || ending == ".svg" || ending == ".pdf");
  if (std::max(drawing.size.width, drawing.size.height) > longest_drawing_edge)
    throw OutputError(path, "the picture has more than " + std::to_string(longest_drawing_edge) + " pixels along an edge");
  const DrawingFormats& formats = drawing_formats();
  const DrawingFormats::BytesOf bytes_of = ending == ".png" ? formats.png : ending == ".svg" ? formats.svg : formats.pdf;
  const std::string bytes = bytes_of(drawing, path);
  write_atomically(path, [&bytes](std::ostream& file) { file << bytes; });
}

std::string png_of(const Drawing& drawing) { return drawing_formats().png(drawing, "a picture in memory"); }

}  // namespace farlod
