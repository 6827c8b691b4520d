// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/source_tree.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <string_view>

namespace farlod {
namespace {

constexpr std::array code_folders{"include",    "console", "gdal",  "preprocess", "runtime", "datasets", "benchmark",
                                  "validation", "tests",   "cmake", "docs",       "scripts", ".ci"};
/// The names of the folders whose files without an ending are scripts.
constexpr std::array<std::string_view, 4> script_folders{"benchmark", "figures", "scripts", ".ci"};

bool is_code(const std::filesystem::path& path) {
  const std::string folder = path.parent_path().filename().string(), ending = path.extension().string();
  const bool script = ending.empty() && std::ranges::count(script_folders, folder) > 0;
  return ending == ".cpp" || ending == ".hpp" || ending == ".cmake" || path.filename() == "CMakeLists.txt" || script;
}

SourceFile read(const std::filesystem::path& root, const std::filesystem::path& path) {
  SourceFile file{std::filesystem::relative(path, root).generic_string(), {}};
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
  return file;
}

}  // namespace

std::vector<SourceFile> read_source_tree(const std::filesystem::path& root) {
  std::vector<SourceFile> files;
  if (std::filesystem::exists(root / "CMakeLists.txt")) files.push_back(read(root, root / "CMakeLists.txt"));
  for (const char* folder : code_folders) {
    if (!std::filesystem::exists(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && is_code(entry.path())) files.push_back(read(root, entry.path()));
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<SourceFile> read_documents(const std::filesystem::path& root) {
  std::vector<SourceFile> files;
  for (const char* name : {"README.md", "CONTRIBUTING.md"}) files.push_back(read(root, root / name));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
    if (entry.is_regular_file() && entry.path().extension() == ".md") files.push_back(read(root, entry.path()));
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
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

bool is_cpp(const SourceFile& file) { return file.path.ends_with(".cpp") || file.path.ends_with(".hpp"); }

}  // namespace farlod
