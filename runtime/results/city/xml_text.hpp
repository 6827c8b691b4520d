// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace farlod {

/// A text that is not the XML that a reader expects. The message says what, and as a rule in which line.
class XmlTextError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The start tag of an element, with the attributes that matter in CityGML. Valid during the call of the reader alone.
struct XmlTag {
  std::string_view space;  ///< the namespace's URI
  std::string_view name;   ///< without prefix
  std::string_view id;     ///< gml:id
  std::string_view href;   ///< xlink:href
  std::string_view srs_name, srs_dimension;
  std::string_view attribute_name;  ///< `name`, as of a generic attribute
  std::size_t end = 0;              ///< one past the last byte of the tag
};

/// Receives the elements of an XML text, with their places in it.
class XmlTextReader {
 public:
  virtual ~XmlTextReader() = default;
  /// A prefix stands for a namespace from the next element on, until `unbind`. The prefix of the default namespace is empty.
  virtual void bind(std::string_view /*prefix*/, std::string_view /*space*/) {}
  virtual void unbind() {}
  virtual void start(const XmlTag& tag) = 0;
  /// `end`: one past the last byte of the element.
  virtual void end(std::size_t end) = 0;
  /// A piece of text. The pieces of one text may begin and end anywhere.
  virtual void text(std::string_view piece) = 0;
};

/// Reads a text in UTF-8, with or without a byte order mark, or in an encoding of one byte a character that begins with ASCII,
/// such as ISO-8859-1. Throws XmlTextError for a text that is not
/// well-formed or has another encoding, and for what attacks on parsers use and no CityGML file needs: declarations in a DOCTYPE,
/// elements nested deeper than 256, and tags of more than 4 MiB. What the reader throws ends the reading.
void read_xml_text(std::string_view text, XmlTextReader& reader);

}  // namespace farlod
