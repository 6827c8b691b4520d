// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace farlod::ingest {

/// The start tag of an XML element, with the attributes that matter in CityGML. Valid during the call of the listener alone.
struct XmlElement {
  std::string_view space;  ///< the namespace's URI
  std::string_view name;   ///< without prefix
  std::string_view id;     ///< gml:id
  std::string_view href;   ///< xlink:href
  std::string_view srs_name, srs_dimension, orientation;
  std::uint64_t end = 0;  ///< one past the last byte of the start tag, in a file that is not packed
};

/// Receives the elements of an XML file.
class XmlListener {
 public:
  virtual ~XmlListener() = default;
  /// A prefix stands for a namespace from the next element on, until unbind() is called for it. The default namespace has an
  /// empty prefix.
  virtual void bind(std::string_view /*prefix*/, std::string_view /*space*/) {}
  virtual void unbind() {}
  virtual void start(const XmlElement& element) = 0;
  /// `end`: one past the last byte of the element, in a file that is not packed.
  virtual void end(std::string_view name, std::uint64_t end) = 0;
  /// A piece of text. The pieces of one text may begin and end anywhere.
  virtual void text(std::string_view piece) = 0;
};

}  // namespace farlod::ingest
