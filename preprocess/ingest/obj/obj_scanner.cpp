// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/cancellation.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/mesh/words.hpp"

namespace farlod::ingest {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Whether the last line of a text that ends before a line break is continued.
bool is_continued(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text.ends_with('\\');
}

/// One past the last line break from `begin` on whose line is not continued; 0 where there is none.
std::size_t end_of_last_line(std::string_view text, std::size_t begin) {
  for (std::size_t end = text.size(); end > begin; --end)
    if (text[end - 1] == '\n' && !is_continued(text.substr(0, end - 1))) return end;
  return 0;
}

class ObjScanner {
 public:
  ObjSegment scan(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!continued_.empty()) read(continued_);
    return std::move(segment_);
  }

 private:
  void take_line(std::string_view line) {
    ++segment_.lines;
    line = trimmed(line);
    if (line.ends_with('\\')) {
      continued_.append(line.substr(0, line.size() - 1)).append(" ");
    } else if (continued_.empty()) {
      read(line);
    } else {
      const std::string whole = std::exchange(continued_, {}).append(line);
      read(whole);
    }
  }

  void read(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = take_word(line);
    if (keyword == "v")
      read_vertex(line);
    else if (keyword == "f")
      read_face(line);
    else if (keyword == "g")
      group_ = add_name(line, mesh_.groups);
    else if (keyword == "o")
      object_ = add_name(line, mesh_.objects);
    else if (keyword == "usemtl")
      material_ = add_name(line, mesh_.materials);
    else if (keyword == "l" || keyword == "p" || keyword == "curv" || keyword == "curv2" || keyword == "surf")
      if (mesh_.unread_elements++ == 0) mesh_.first_unread_line = segment_.lines;
  }

  void read_vertex(std::string_view line) {
    Point3d p;
    for (double* coordinate : {&p.x, &p.y, &p.z}) *coordinate = coordinate_from(take_word(line));
    mesh_.vertices.push_back(p);
  }

  void read_face(std::string_view line) {
    MeshFace face{mesh_.corners.size(), 0, group_, object_, material_, segment_.lines};
    const std::size_t relative_before = segment_.relative_corners.size();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::string_view number = word.substr(0, word.find('/'));
      std::int64_t index = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
      if (error != std::errc() || end != number.data() + number.size()) {
        mesh_.malformed_lines.push_back(segment_.lines);
        mesh_.corners.resize(face.first_corner);
        segment_.relative_corners.resize(relative_before);
        return;
      }
      if (index < 0) segment_.relative_corners.push_back(mesh_.corners.size());
      mesh_.corners.push_back(index < 0 ? static_cast<std::int64_t>(mesh_.vertices.size()) + index : index - 1);
      ++face.corner_count;
    }
    mesh_.faces.push_back(face);
  }

  static std::uint32_t add_name(std::string_view line, std::vector<std::string>& names) {
    names.emplace_back(trimmed(line));
    return static_cast<std::uint32_t>(names.size() - 1);
  }

  ObjSegment segment_;
  Mesh& mesh_ = segment_.mesh;
  std::uint32_t group_ = 0, object_ = 0, material_ = 0;
  std::string continued_;
};

/// Appends names, but for the first: faces of row 0 belong to the last statement of the segments before.
void append_names(std::vector<std::string>& next, std::vector<std::string>& names) {
  names.insert(names.end(), std::move_iterator(next.begin() + 1), std::move_iterator(next.end()));
}

}  // namespace

bool ObjSegmentCutter::read_on() {
  const std::size_t known = ahead_.size();
  ahead_.resize(known + segment_bytes_);
  text_.read(ahead_.data() + known, static_cast<std::streamsize>(segment_bytes_));
  ahead_.resize(known + static_cast<std::size_t>(text_.gcount()));
  return ahead_.size() > known;
}

std::optional<std::string> ObjSegmentCutter::next() {
  for (std::size_t known = ahead_.size(); read_on(); known = ahead_.size()) {
    if (is_first_ && ahead_.size() < byte_order_mark.size()) continue;
    if (std::exchange(is_first_, false) && ahead_.starts_with(byte_order_mark)) ahead_.erase(0, byte_order_mark.size());
    // What was read before has no end of a line: it was looked for there
    const std::size_t end = end_of_last_line(ahead_, known);
    if (end == 0) continue;
    std::string rest = ahead_.substr(end);
    ahead_.resize(end);
    return std::exchange(ahead_, std::move(rest));
  }
  return ahead_.empty() ? std::nullopt : std::optional(std::exchange(ahead_, {}));
}

namespace {

ObjSegment scan_obj_segment(std::string_view text) { return ObjScanner().scan(text); }

}  // namespace

void append(ObjSegment&& next, std::uint64_t lines_before, Mesh& mesh) {
  const auto first_vertex = static_cast<std::int64_t>(mesh.vertices.size());
  const std::uint64_t first_corner = mesh.corners.size();
  const auto last_group = static_cast<std::uint32_t>(mesh.groups.size() - 1),
             last_object = static_cast<std::uint32_t>(mesh.objects.size() - 1),
             last_material = static_cast<std::uint32_t>(mesh.materials.size() - 1);
  for (const std::size_t corner : next.relative_corners) next.mesh.corners[corner] += first_vertex;
  for (MeshFace& face : next.mesh.faces) {
    face.first_corner += first_corner;
    face.group += last_group;
    face.object += last_object;
    face.material += last_material;
    face.line += lines_before;
  }
  mesh.vertices.append(next.mesh.vertices);
  mesh.corners.append(next.mesh.corners);
  mesh.faces.append(next.mesh.faces);
  append_names(next.mesh.groups, mesh.groups);
  append_names(next.mesh.objects, mesh.objects);
  append_names(next.mesh.materials, mesh.materials);
  for (const std::uint64_t line : next.mesh.malformed_lines) mesh.malformed_lines.push_back(lines_before + line);
  if (mesh.unread_elements == 0 && next.mesh.unread_elements > 0)
    mesh.first_unread_line = lines_before + next.mesh.first_unread_line;
  mesh.unread_elements += next.mesh.unread_elements;
}

Mesh scan_obj(std::istream& text, const std::stop_token& stop, std::size_t segment_bytes) {
  /// A segment that is being parsed, or waits for its turn.
  struct InFlight {
    std::string text;
    ObjSegment segment;
  };
  std::vector<InFlight> in_flight(places_for_threads());
  ObjSegmentCutter cutter(text, segment_bytes);
  Mesh mesh;
  std::uint64_t lines = 0;
  const auto cut = [&](std::size_t place) {
    throw_if_cancelled(stop);
    std::optional<std::string> next = cutter.next();
    if (next) in_flight[place].text = std::move(*next);
    return next.has_value();
  };
  const auto scan = [&](std::size_t place) { in_flight[place].segment = scan_obj_segment(in_flight[place].text); };
  const auto append_one = [&](std::size_t place) {
    InFlight done = std::exchange(in_flight[place], {});
    const std::uint64_t lines_before = std::exchange(lines, lines + done.segment.lines);
    append(std::move(done.segment), lines_before, mesh);
  };
  run_in_order(in_flight.size(), {cut, scan, append_one});
  return mesh;
}

}  // namespace farlod::ingest
