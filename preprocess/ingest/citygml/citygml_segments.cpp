// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_segments.hpp"

#include <algorithm>
#include <string_view>

#include "ingest/citygml/citygml_xml.hpp"

namespace farlod::ingest {
namespace {

/// The start tag of the root, with the namespaces of many extensions, is a few KiB long.
constexpr std::size_t most_bytes_of_head = std::size_t{1} << 16;
constexpr std::string_view member = "cityObjectMember>";

/// Whether the name that ends at `end` is that of an end tag.
bool is_end_tag(std::string_view text, std::size_t end) {
  const std::size_t before = text.substr(0, end).find_last_of("</> \t\r\n");
  return before != text.npos && before > 0 && text.substr(before - 1, 2) == "</";
}

/// One past the last end tag of a member; 0 where there is none.
std::size_t end_of_last_member(std::string_view text) {
  for (std::size_t at = text.rfind(member); at != text.npos; at = at == 0 ? text.npos : text.rfind(member, at - 1))
    if (is_end_tag(text, at)) return at + member.size();
  return 0;
}

}  // namespace

SegmentCutter::SegmentCutter(const InputFile& file, const SegmentSizes& sizes) : stream_(open_input(file)), sizes_(sizes) {
  *stream_ >> std::ws;
  if (const std::streamoff begin = stream_->tellg(); begin > 0) at_ahead_ = static_cast<std::uint64_t>(begin);
  read_up_to(most_bytes_of_head);
  const std::optional<XmlRoot> root = find_root(ahead_);
  if (!root || root->name != "CityModel") throw CannotBeCut();
  head_ = ahead_.substr(0, root->tag_end);
  ahead_.erase(0, root->tag_end);
  at_ahead_ += root->tag_end;
}

void SegmentCutter::read_up_to(std::size_t bytes) {
  if (ahead_.size() >= bytes) return;
  const std::size_t known = ahead_.size();
  ahead_.resize(bytes);
  stream_->read(ahead_.data() + known, static_cast<std::streamsize>(bytes - known));
  ahead_.resize(known + static_cast<std::size_t>(stream_->gcount()));
}

std::optional<FileSegment> SegmentCutter::next() {
  if (is_done_) return std::nullopt;
  for (std::size_t bytes = std::min(sizes_.least, sizes_.most);; bytes = std::min(2 * bytes, sizes_.most)) {
    read_up_to(bytes);
    is_done_ = !*stream_ && ahead_.size() <= bytes;
    if (is_done_) return FileSegment{std::move(ahead_), true, at_ahead_};
    if (const std::size_t end = end_of_last_member(std::string_view(ahead_).substr(0, bytes)); end > 0) {
      FileSegment segment{ahead_.substr(0, end), false, at_ahead_};
      ahead_.erase(0, end);
      at_ahead_ += end;
      return segment;
    }
    if (bytes == sizes_.most) throw CannotBeCut();
  }
}

}  // namespace farlod::ingest
