// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>

namespace farlod {
namespace {

constexpr std::array folders{"include",  "base",      "package",    "console", "gdal",  "preprocess", "runtime",
                             "datasets", "benchmark", "validation", "tests",   "cmake", "docs",       "scripts",
                             ".ci",      ".github",   "packaging",  "python",  "qgis",  "viewer"};

/// Whether a file without an ending says what runs it.
bool is_script(const std::filesystem::path& path) {
  if (path.has_extension()) return false;
  std::ifstream file(path);
  return file.get() == '#' && file.get() == '!';
}

bool is_code(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".cpp" || ending == ".hpp" || ending == ".cmake" || ending == ".py" || ending == ".ts" || ending == ".mjs" ||
         path.filename() == "CMakeLists.txt" || is_script(path);
}

/// What npm installs.
bool is_of_others(const std::filesystem::path& path) { return path.filename() == "node_modules"; }

bool is_document(const std::filesystem::path& path) { return path.extension() == ".md"; }

SourceFile read(const std::filesystem::path& root, const std::filesystem::path& path) {
  SourceFile file{std::filesystem::relative(path, root).generic_string(), {}};
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
  return file;
}

/// The files of the project, those right at its root included, for which a condition holds; ordered by path.
template <class Condition>
std::vector<SourceFile> read_where(const std::filesystem::path& root, Condition condition) {
  std::vector<SourceFile> files;
  const auto add = [&](const std::filesystem::directory_entry& entry) {
    if (entry.is_regular_file() && condition(entry.path())) files.push_back(read(root, entry.path()));
  };
  for (const auto& entry : std::filesystem::directory_iterator(root)) add(entry);
  for (const char* folder : folders)
    if (std::filesystem::exists(root / folder))
      for (std::filesystem::recursive_directory_iterator entry(root / folder), end; entry != end; ++entry)
        is_of_others(entry->path()) ? entry.disable_recursion_pending() : add(*entry);
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::vector<SourceFile> read_source_tree(const std::filesystem::path& root) { return read_where(root, is_code); }

std::vector<SourceFile> read_documents(const std::filesystem::path& root) { return read_where(root, is_document); }

std::vector<SourceFile> read_all_texts(const std::filesystem::path& root) {
  std::vector<SourceFile> files = read_where(root, [](const std::filesystem::path&) { return true; });
  // Pictures and archives have zero bytes, text has none
  std::erase_if(files, [](const SourceFile& file) {
    return std::ranges::any_of(file.lines, [](const std::string& line) { return line.find('\0') != std::string::npos; });
  });
  return files;
}

std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (std::size_t n = 0; n < file.lines.size(); ++n) {
    std::smatch match;
    if (std::regex_search(file.lines[n], match, include)) includes.push_back({match[2], match[1] == "\"", n + 1});
  }
  return includes;
}

bool is_script_of_page(const SourceFile& file) { return file.path.ends_with(".ts") || file.path.ends_with(".mjs"); }
bool is_cpp(const SourceFile& file) { return file.path.ends_with(".cpp") || file.path.ends_with(".hpp"); }

}  // namespace farlod
