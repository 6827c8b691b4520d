// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_surface_finder.hpp"

namespace farlod {

bool GmlSurfaceFinder::is_wanted(std::string_view id) {
  if (id.empty()) return false;
  href_.assign(1, '#').append(id);
  return hrefs_.contains(href_);
}

void GmlSurfaceFinder::start(const XmlElement& element) {
  if (skipped_depth_ > 0) {
    ++skipped_depth_;
  } else if (wanted_depth_ > 0 || is_wanted(element.id)) {
    if (reader_.start(element) == GmlSurfaceReader::Answer::entered)
      ++wanted_depth_;
    else
      ++skipped_depth_;
  }
}

void GmlSurfaceFinder::end(std::string_view name) {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
  } else if (wanted_depth_ > 0) {
    reader_.end(name);
    --wanted_depth_;
  }
}

void GmlSurfaceFinder::text(std::string_view piece) {
  if (wanted_depth_ > 0 && skipped_depth_ == 0) reader_.text(piece);
}

}  // namespace farlod
