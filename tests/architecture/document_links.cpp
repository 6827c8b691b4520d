// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/document_links.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

namespace farlod {
namespace {

struct Link {
  std::string target;
  std::size_t line = 0;
};

/// The lines of a document with nothing in the place of blocks of code.
std::vector<std::string> lines_of_prose(const SourceFile& document) {
  std::vector<std::string> lines;
  bool is_code = false;
  for (const std::string& line : document.lines) {
    const bool fence = line.starts_with("```");
    lines.push_back(is_code || fence ? "" : line);
    is_code = is_code != fence;
  }
  return lines;
}

/// The anchor that a heading gets: small letters, no punctuation, hyphens for blanks. Bytes of UTF-8 stay as they are.
std::string anchor_of(const std::string& heading) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::string anchor;
  for (const char c : std::regex_replace(heading, link, "$1")) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || c == '-' || c == '_') anchor += c;
    if (c == ' ') anchor += '-';
    if (byte < 0x80 && std::isalnum(byte) != 0) anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

/// The anchors of all headings; a second one of the same words gets `-1`.
std::set<std::string> anchors_of(const SourceFile& document) {
  static const std::regex heading(R"(^#{1,6} +(.*?) *#*$)");
  static const std::regex named(R"re(<a (?:id|name)="([^"]+)")re");
  std::map<std::string, int> count;
  std::set<std::string> anchors;
  for (const std::string& line : lines_of_prose(document)) {
    std::smatch match;
    if (std::regex_search(line, match, named)) anchors.insert(match[1]);
    if (!std::regex_match(line, match, heading)) continue;
    const std::string anchor = anchor_of(match[1]);
    const int before = count[anchor]++;
    anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return anchors;
}

/// Of `[text](target)`, `![text](target "title")`, `[name]: target` and `<img src="target">`.
std::vector<Link> links_of(const SourceFile& document) {
  static const std::regex code("`[^`]*`");
  static const std::regex link(R"re(\]\(([^)\s]+)(?: "[^"]*")?\)|^\[[^\]]+\]: *(\S+)|<(?:img|a) [^>]*(?:src|href)="([^"]+)")re");
  std::vector<Link> links;
  const std::vector<std::string> lines = lines_of_prose(document);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    // The text of a link may be code, so that code shrinks to nothing instead of being cut out with what is around it
    const std::string line = std::regex_replace(lines[n], code, "``");
    for (std::sregex_iterator match(line.begin(), line.end(), link); match != std::sregex_iterator(); ++match)
      for (const std::size_t part : {1U, 2U, 3U})
        if ((*match)[part].matched) links.push_back({(*match)[part], n + 1});
  }
  return links;
}

bool leads_elsewhere(const std::string& target) {
  static const std::regex scheme("^[a-zA-Z][a-zA-Z0-9+.-]*:.*");
  return std::regex_match(target, scheme);
}

/// The path from the root that a target means in this document.
std::string path_of(const std::string& target, const SourceFile& document) {
  if (target.empty()) return document.path;
  const std::filesystem::path path = std::filesystem::path(document.path).parent_path() / target;
  return path.lexically_normal().generic_string();
}

}  // namespace

std::vector<std::string> dead_links(const std::vector<SourceFile>& documents, const Exists& exists) {
  std::map<std::string, std::set<std::string>> anchors;
  for (const SourceFile& document : documents) anchors[document.path] = anchors_of(document);
  std::vector<std::string> dead;
  for (const SourceFile& document : documents)
    for (const Link& link : links_of(document)) {
      if (leads_elsewhere(link.target)) continue;
      const std::size_t hash = std::min(link.target.find('#'), link.target.size());
      const std::string path = path_of(link.target.substr(0, hash), document), anchor = link.target.substr(hash);
      // Other files than documents have lines for anchors, such as #L12, which nobody should write
      const bool leads_somewhere = exists(path) && (anchor.empty() || anchors[path].contains(anchor.substr(1)));
      if (!leads_somewhere) dead.push_back(document.path + ":" + std::to_string(link.line) + " " + link.target);
    }
  return dead;
}

}  // namespace farlod
