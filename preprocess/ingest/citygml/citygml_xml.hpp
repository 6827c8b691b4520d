// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The longest text of a height, a name or a keyword that is kept.
inline constexpr std::size_t most_words = 256;

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

/// A CityGML file cannot be cut into segments, or one of them cannot be read by itself. What is wrong, if anything, is found by
/// reading the file as a whole. Leaves the folder never.
class CannotBeCut : public std::runtime_error {
 public:
  CannotBeCut() : std::runtime_error("the file cannot be cut into segments") {}
};

/// The bytes of a segment.
struct SegmentSizes {
  std::size_t least = std::size_t{1} << 19;  ///< reading one is much more work than starting to
  std::size_t most = std::size_t{1} << 22;   ///< not more than parse_xml_segment takes: an object of the city may be as large
};

struct FileSegment {
  std::string text;
  bool is_last = false;
  std::uint64_t begin = 0;  ///< its place in a file that is not packed
};

/// Cuts a CityGML file behind end tags of cityObjectMember, as far as the text tells: what looks like one may be within a
/// comment. parse_xml_segment notices that.
class SegmentCutter {
 public:
  /// Throws CannotBeCut for a file whose root is not a CityModel, and InputError as open_input does.
  SegmentCutter(const InputFile& file, const SegmentSizes& sizes);

  /// The file up to the end of the root's start tag.
  [[nodiscard]] const std::string& head() const { return head_; }
  /// The next segment, which begins where the one before ends; empty after the last. Throws CannotBeCut where none ends within
  /// the largest size.
  [[nodiscard]] std::optional<FileSegment> next();

 private:
  void read_up_to(std::size_t bytes);

  std::unique_ptr<std::istream> stream_;
  SegmentSizes sizes_;
  std::string head_, ahead_;    ///< `ahead_`: what was read and not handed out yet
  std::uint64_t at_ahead_ = 0;  ///< its place in the file
  bool is_done_ = false;
};

}  // namespace farlod::ingest
