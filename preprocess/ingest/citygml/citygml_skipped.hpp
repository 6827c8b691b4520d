// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "ingest/citygml/xml_element.hpp"

namespace farlod::ingest {

/// Counts the skipped features of a CityGML file by the name of the element without its prefix. The namespace of an extension
/// follows the name: "RiverFloodingRiskAttribute (https://www.geospatial.jp/iur/uro/2.0)".
class SkippedCount {
 public:
  /// All further names are counted as one, so that no file can make the table grow without limit.
  static constexpr std::size_t most_names = 100;
  static constexpr const char* other_names = "elements of still other names";

  void add(const XmlElement& element);
  /// Adds the counts of the next segment of the file. Returns false when there are so many names that the two segments, read as
  /// one, might tell others apart.
  [[nodiscard]] bool append(const SkippedCount& next);
  [[nodiscard]] const SkippedFeatures& counts() const { return counts_; }

 private:
  SkippedFeatures counts_;
};

}  // namespace farlod::ingest
