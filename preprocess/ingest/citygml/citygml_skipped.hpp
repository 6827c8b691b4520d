// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "ingest/citygml/xml_element.hpp"

namespace farlod::ingest {

/// Counts what a CityGML file has and we do not use, by the name of the element without its prefix. Elements of extensions
/// have their namespace behind the name: "RiverFloodingRiskAttribute (https://www.geospatial.jp/iur/uro/2.0)".
class SkippedCount {
 public:
  /// Names beyond so many are counted together, so that no file can make the table grow without end.
  static constexpr std::size_t most_names = 100;
  static constexpr const char* other_names = "elements of still other names";

  void add(const XmlElement& element);
  [[nodiscard]] const SkippedFeatures& counts() const { return counts_; }

 private:
  SkippedFeatures counts_;
};

}  // namespace farlod::ingest
