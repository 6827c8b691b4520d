// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string_view>

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

namespace {

namespace fs = std::filesystem;

bool is_markdown(const SourceFile& file) { return file.path.ends_with(".md"); }

/// The names and numbers of a line. By hand, since all lines of the project are read.
std::vector<std::string> words_in(std::string_view line) {
  const auto is_part = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::vector<std::string> words;
  for (auto begin = line.begin(); begin != line.end();) {
    begin = std::find_if(begin, line.end(), is_part);
    const auto end = std::find_if_not(begin, line.end(), is_part);
    if (begin != end) words.emplace_back(begin, end);
    begin = end;
  }
  return words;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

bool is_same_but_for_ending(const std::string& path, const std::string& without_ending) {
  return path.starts_with(without_ending + ".") && path.find('/', without_ending.size()) == std::string::npos;
}

/// Whether the tree has this path. What a build makes of `x.in` counts as x.
bool has_path(const NamedTree& tree, const std::string& path) {
  if (tree.paths.contains(path) || tree.paths.contains(path + ".in")) return true;
  if (path.find('*') == std::string::npos) {
    const auto next = tree.paths.lower_bound(path + ".");
    return next != tree.paths.end() && is_same_but_for_ending(*next, path);
  }
  std::string pattern = std::regex_replace(path, std::regex(R"([.+])"), R"(\$&)");
  pattern = std::regex_replace(pattern, std::regex(R"(\*)"), "[^/]*");
  const std::regex matches(pattern);
  return std::ranges::any_of(tree.paths, [&](const std::string& p) { return std::regex_match(p, matches); });
}

bool has_file_named(const NamedTree& tree, const std::string& name) {
  return std::ranges::any_of(tree.paths, [&](const std::string& path) {
    return path == name || path.ends_with("/" + name) || path.ends_with("/" + name + ".in");
  });
}

/// The texts that a document means by a name of a file, with or without folders.
std::vector<const SourceFile*> files_meant(const NamedTree& tree, const std::string& name) {
  std::vector<const SourceFile*> files;
  for (const SourceFile& file : *tree.texts)
    if (file.path == name || file.path.ends_with("/" + name)) files.push_back(&file);
  return files;
}

bool has_word(const SourceFile& file, const std::string& word) {
  return std::ranges::any_of(file.lines, [&](const std::string& line) { return std::ranges::count(words_in(line), word) > 0; });
}

/// Rules (1) to (3) for what stands between two backticks.
bool is_dead(const std::string& name, const std::string& document, const NamedTree& tree) {
  static const std::regex path(R"(\.?[\w.+*-]+(/[\w.+*-]+)*/?)"), source(R"([\w-][\w.-]*\.(hpp|cpp|md|py|ts|mjs|cmake|css))"),
      function(R"((\w+::)*\w+\(\)|(\w+::)+\w+)"), foreign("(std|CGAL)::.*");
  if (name.find('/') != std::string::npos && std::regex_match(name, path) && tree.paths.contains(first_folder(name))) {
    const std::string from_root = name.ends_with('/') ? name.substr(0, name.size() - 1) : name;
    const fs::path from_document = (fs::path(document).parent_path() / from_root).lexically_normal();
    return !has_path(tree, from_root) && !has_path(tree, from_document.generic_string());
  }
  if (std::regex_match(name, source)) return !has_file_named(tree, name);
  return std::regex_match(name, function) && !std::regex_match(name, foreign) &&
         std::ranges::any_of(words_in(name), [&](const std::string& word) { return !tree.words.contains(word); });
}

/// Rule (4), for one line.
void add_names_elsewhere(const std::string& line, const std::string& place, const NamedTree& tree,
                         std::vector<std::string>& dead) {
  static const std::regex pair(R"re(`(\w+)` \(`([\w/.-]+\.(?:hpp|cpp|py|ts))`\))re");
  for (std::sregex_iterator match(line.begin(), line.end(), pair), end; match != end; ++match) {
    const std::string name = (*match)[1], file = (*match)[2];
    const std::vector<const SourceFile*> meant = files_meant(tree, file);
    if (!meant.empty() && std::ranges::none_of(meant, [&](const SourceFile* f) { return has_word(*f, name); }))
      dead.push_back(place + name + " in " + file);
  }
}

void add_dead_names(const SourceFile& document, const NamedTree& tree, std::vector<std::string>& dead) {
  static const std::regex code("`([^`]+)`");
  bool is_block = false;
  for (std::size_t n = 0; n < document.lines.size(); ++n) {
    const std::string& line = document.lines[n];
    const bool is_fence = line.starts_with("```");
    is_block = is_block != is_fence;
    if (is_block || is_fence) continue;
    const std::string place = document.path + ":" + std::to_string(n + 1) + " ";
    for (std::sregex_iterator match(line.begin(), line.end(), code), end; match != end; ++match)
      if (is_dead((*match)[1], document.path, tree)) dead.push_back(place + (*match)[1].str());
    add_names_elsewhere(line, place, tree, dead);
  }
}

}  // namespace

NamedTree::NamedTree(const std::vector<SourceFile>& all_texts) : texts(&all_texts) {
  for (const SourceFile& file : all_texts) {
    for (fs::path path = file.path; !path.empty(); path = path.parent_path()) paths.insert(path.generic_string());
    // What others wrote into one file says nothing about names of ours
    if (is_markdown(file) || file.path.starts_with("viewer/bundle/")) continue;
    for (const std::string& line : file.lines)
      for (std::string& word : words_in(line)) words.insert(std::move(word));
  }
}

std::vector<std::string> dead_names(const std::vector<SourceFile>& documents, const NamedTree& tree) {
  std::vector<std::string> dead;
  for (const SourceFile& document : documents) add_dead_names(document, tree, dead);
  return dead;
}

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the characters [begin, end) are followed or preceded by more of a number. A full stop ends a sentence; a point
/// beside a digit belongs to a number.
bool is_part_of_longer(std::string_view line, std::size_t begin, std::size_t end) {
  const std::string_view before = line.substr(0, begin), after = line.substr(end);
  if (!before.empty() && (is_digit(before.back()) || before.back() == '.')) return true;
  return !after.empty() && (is_digit(after[0]) || (after.size() > 1 && after[0] == '.' && is_digit(after[1])));
}

bool mentions(std::string_view line, std::string_view version) {
  for (std::size_t at = line.find(version); at != std::string_view::npos; at = line.find(version, at + 1))
    if (!is_part_of_longer(line, at, at + version.size())) return true;
  return false;
}

}  // namespace

std::vector<std::string> mentions_of_version(const std::vector<SourceFile>& files, std::string_view version) {
  std::vector<std::string> found;
  for (const SourceFile& file : files)
    for (std::size_t n = 0; n < file.lines.size(); ++n)
      if (mentions(file.lines[n], version)) found.push_back(file.path + ":" + std::to_string(n + 1));
  return found;
}

std::string topmost_release(const SourceFile& changelog) {
  static const std::regex release(R"(^## \[(\d+\.\d+\.\d+)\].*)");
  for (const std::string& line : changelog.lines) {
    std::smatch match;
    if (std::regex_match(line, match, release)) return match[1];
  }
  return "";
}

}  // namespace farlod
