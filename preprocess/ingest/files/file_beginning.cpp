// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/file_beginning.hpp"

#include <algorithm>
#include <array>

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF"sv;

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

std::string every_other(std::string_view bytes, std::size_t first) {
  std::string text;
  for (std::size_t k = first; k < bytes.size(); k += 2) text += bytes[k];
  return text;
}

/// The text after the first `mark`; empty when there is no mark.
std::string_view after(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  return at == text.npos ? std::string_view() : text.substr(at + mark.size());
}

/// The text after a document type. It may contain definitions in brackets, each of which has a `>` of its own.
std::string_view after_document_type(std::string_view text) {
  const std::size_t bracket = text.find('['), end = text.find('>');
  return after(bracket < end ? after(text, "]") : text, ">");
}

constexpr std::array obj_keywords{"v"sv,      "vt"sv,  "vn"sv,    "vp"sv,       "f"sv,       "fo"sv,     "g"sv,      "o"sv,
                                  "s"sv,      "l"sv,   "p"sv,     "mg"sv,       "mtllib"sv,  "usemtl"sv, "usemap"sv, "maplib"sv,
                                  "cstype"sv, "deg"sv, "curv"sv,  "curv2"sv,    "surf"sv,    "parm"sv,   "trim"sv,   "hole"sv,
                                  "end"sv,    "lod"sv, "bevel"sv, "c_interp"sv, "d_interp"sv};

}  // namespace

std::string plain_beginning(std::string_view bytes) {
  if (bytes.starts_with("\xFE\xFF"sv)) return plain_beginning(every_other(bytes, 3));
  if (bytes.starts_with("\xFF\xFE"sv)) return plain_beginning(every_other(bytes, 2));
  if (bytes.starts_with("<\0"sv)) return every_other(bytes, 0);
  if (bytes.starts_with("\0<"sv)) return every_other(bytes, 1);
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  return std::string(without_blanks(bytes));
}

std::string_view root_tag(std::string_view xml) {
  while (true) {
    xml = without_blanks(xml);
    if (xml.starts_with("<?"))
      xml = after(xml, "?>");
    else if (xml.starts_with("<!--"))
      xml = after(xml, "-->");
    else if (xml.starts_with("<!"))
      xml = after_document_type(xml);
    else
      return xml.starts_with('<') ? xml.substr(1, xml.find('>') - 1) : std::string_view();
  }
}

bool is_citygml_root(std::string_view root_tag) {
  std::string_view name = root_tag.substr(0, root_tag.find_first_of(" \t\r\n/>"));
  name = name.substr(name.find(':') + 1);
  return name == "CityModel" || (name == "FeatureCollection" && root_tag.find("opengis.net/citygml") != root_tag.npos);
}

bool is_obj_text(std::string_view text, bool is_whole) {
  constexpr int enough_statements = 100;
  int statements = 0;
  for (bool is_continued = false; !text.empty() && statements < enough_statements;) {
    const std::size_t end = text.find('\n');
    if (end == text.npos && !is_whole) break;
    std::string_view line = without_blanks(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    const bool is_statement = !is_continued && !line.empty() && line[0] != '#';
    line = line.substr(0, line.find_last_not_of(blanks) + 1);
    is_continued = line.ends_with('\\');
    if (!is_statement) continue;
    const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
    if (std::find(obj_keywords.begin(), obj_keywords.end(), keyword) == obj_keywords.end()) return false;
    ++statements;
  }
  return statements > 0;
}

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\3\4"sv) || bytes.starts_with("PK\5\6"sv); }

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"sv); }

bool is_archive(std::string_view bytes) {
  constexpr std::size_t tar_mark_at = 257;
  if (bytes.size() > tar_mark_at && bytes.substr(tar_mark_at).starts_with("ustar")) return true;
  for (const std::string_view mark : {"7z\xBC\xAF\x27\x1C"sv, "Rar!\x1A\x07"sv, "BZh"sv,
                                      "\xFD"
                                      "7zXZ"sv,
                                      "\x28\xB5\x2F\xFD"sv})
    if (bytes.starts_with(mark)) return true;
  return is_zip(bytes) || is_gzip(bytes);
}

}  // namespace farlod::ingest
