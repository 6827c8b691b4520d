// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

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
