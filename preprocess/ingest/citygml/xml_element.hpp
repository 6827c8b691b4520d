// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace farlod::ingest {

/// The start tag of an XML element, with the attributes that matter in CityGML. Valid during the call of the listener alone.
struct XmlElement {
  std::string_view space;  ///< the namespace's URI
  std::string_view name;   ///< without prefix
  std::string_view id;     ///< gml:id
  std::string_view href;   ///< xlink:href
  std::string_view srs_name, srs_dimension, orientation;
};

/// Receives the elements of an XML file.
class XmlListener {
 public:
  virtual ~XmlListener() = default;
  virtual void start(const XmlElement& element) = 0;
  virtual void end(std::string_view name) = 0;
  /// A piece of text. The pieces of one text may begin and end anywhere.
  virtual void text(std::string_view piece) = 0;
};

}  // namespace farlod::ingest
