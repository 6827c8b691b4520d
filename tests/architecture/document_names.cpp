// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/document_names.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string_view>

namespace farlod {
namespace {

namespace fs = std::filesystem;

bool is_document(const SourceFile& file) { return file.path.ends_with(".md"); }

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
    if (is_document(file) || file.path.starts_with("viewer/bundle/")) continue;
    for (const std::string& line : file.lines)
      for (std::string& word : words_in(line)) words.insert(std::move(word));
  }
}

std::vector<std::string> dead_names(const std::vector<SourceFile>& documents, const NamedTree& tree) {
  std::vector<std::string> dead;
  for (const SourceFile& document : documents) add_dead_names(document, tree, dead);
  return dead;
}

}  // namespace farlod
