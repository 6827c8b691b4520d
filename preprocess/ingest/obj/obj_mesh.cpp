// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_mesh.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

namespace farlod::ingest {
namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 20;
constexpr std::string_view blanks = " \t\r\v\f", byte_order_mark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string_view take_word(std::string_view& rest) {
  rest = rest.substr(std::min(rest.find_first_not_of(blanks), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
  rest.remove_prefix(word.size());
  return word;
}

/// NaN for a word that is not a number. The rings that use it are then reported as unreadable.
double coordinate_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

class ObjScanner {
 public:
  ObjMesh scan(std::istream& stream) {
    std::string text;  // a piece of the file, and before it what the piece before it began
    for (bool is_first = true; read_piece(stream, text); is_first = false) {
      if (is_first && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
      const std::size_t end_of_lines = text.rfind('\n') + 1;
      take_lines(std::string_view(text).substr(0, end_of_lines));
      text.erase(0, end_of_lines);
    }
    take_lines(text);
    if (!continued_.empty()) read(continued_);
    return std::move(mesh_);
  }

 private:
  static bool read_piece(std::istream& stream, std::string& text) {
    const std::size_t known = text.size();
    text.resize(known + piece_bytes);
    stream.read(text.data() + known, static_cast<std::streamsize>(piece_bytes));
    text.resize(known + static_cast<std::size_t>(stream.gcount()));
    return text.size() > known;
  }

  void take_lines(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void take_line(std::string_view line) {
    ++line_;
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
    else if (keyword == "l" || keyword == "p" || keyword == "curv" || keyword == "curv2" || keyword == "surf")
      if (mesh_.unread_elements++ == 0) mesh_.first_unread_line = line_;
  }

  void read_vertex(std::string_view line) {
    Point3d p;
    for (double* coordinate : {&p.x, &p.y, &p.z}) *coordinate = coordinate_from(take_word(line));
    mesh_.vertices.push_back(p);
  }

  void read_face(std::string_view line) {
    ObjFace face{mesh_.corners.size(), 0, group_, object_, line_};
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::string_view number = word.substr(0, word.find('/'));
      std::int64_t index = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
      if (error != std::errc() || end != number.data() + number.size()) {
        mesh_.malformed_lines.push_back(line_);
        mesh_.corners.resize(face.first_corner);
        return;
      }
      mesh_.corners.push_back(index < 0 ? static_cast<std::int64_t>(mesh_.vertices.size()) + index : index - 1);
      ++face.corner_count;
    }
    mesh_.faces.push_back(face);
  }

  static std::uint32_t add_name(std::string_view line, std::vector<std::string>& names) {
    names.emplace_back(trimmed(line));
    return static_cast<std::uint32_t>(names.size() - 1);
  }

  ObjMesh mesh_;
  std::uint32_t group_ = 0, object_ = 0;
  std::uint64_t line_ = 0;
  std::string continued_;
};

}  // namespace

ObjMesh scan_obj(std::istream& text) { return ObjScanner().scan(text); }

}  // namespace farlod::ingest
