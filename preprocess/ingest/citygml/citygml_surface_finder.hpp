// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/citygml/xml_element.hpp"

namespace farlod {

/// Finds the surfaces with certain ids anywhere in a file, for buildings that refer to what is not their own.
class GmlSurfaceFinder : public XmlListener {
 public:
  /// `hrefs` are references as the file writes them; those into other files ("town.gml#a") are never found.
  explicit GmlSurfaceFinder(const std::unordered_set<std::string>& hrefs) : hrefs_(hrefs) {}

  void start(const XmlElement& element) override;
  void end(std::string_view name) override;
  void text(std::string_view piece) override;

  [[nodiscard]] GmlSurfaces& found() { return found_; }

 private:
  [[nodiscard]] bool is_wanted(std::string_view id);

  const std::unordered_set<std::string>& hrefs_;
  GmlSurfaces found_;
  GmlSurfaceReader reader_{found_};
  std::size_t wanted_depth_ = 0, skipped_depth_ = 0;
  std::string href_;  ///< what a reference to the id in hand looks like
};

}  // namespace farlod
