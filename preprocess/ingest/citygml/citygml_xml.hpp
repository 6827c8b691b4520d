// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "ingest/citygml/xml_element.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Parses a whole XML file in UTF-8, UTF-16 or any encoding of one byte a character, and calls a listener for each element and
/// text. The only wrapper of Expat. Throws InputError, with line and column, for a file that is not well-formed. It also refuses
/// what attacks use and no CityGML file needs: declarations in a DOCTYPE (entities that expand without limit or refer to other
/// files), elements nested deeper than 256, and tags of more than 4 MiB. Throws Cancelled when a stop is requested.
void parse_xml(const InputFile& file, XmlListener& listener, const std::stop_token& stop = {});

struct XmlRoot {
  std::string name;         ///< without prefix
  std::size_t tag_end = 0;  ///< one past the last byte of its start tag
};

/// The root of an XML file, if its start tag ends within this beginning of the file.
[[nodiscard]] std::optional<XmlRoot> find_root(std::string_view beginning);

/// A segment of an XML file that is parsed by itself. All but the first begin where the one before ends.
struct XmlSegment {
  std::string_view head;  ///< the file up to the end of the root's start tag, which precedes each segment once more
  std::string_view text;
  bool is_last = false;
  std::uint64_t begin = 0;  ///< the place of the text in the file
};

/// Parses a segment, and calls the listener for the root's start tag, too. Returns whether the segment can be told to be parsed
/// as within the whole file, by a parser that would then parse the next segment as itself: when the segment begins in the content
/// of the root, outside of all its elements, and is well-formed and ends like that, with the end tag of a child of the root. The
/// last one ends with the file. Where that does not hold, or something is refused, the listener has been called in vain. `text`
/// may not be longer than a tag that parse_xml reads.
[[nodiscard]] bool parse_xml_segment(const XmlSegment& segment, XmlListener& listener);

}  // namespace farlod::ingest
