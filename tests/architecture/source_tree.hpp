// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace farlod {

/// A file of the project: its path from the root with forward slashes, and its lines.
struct SourceFile {
  std::string path;
  std::vector<std::string> lines;
};

/// What stands between the quotes or brackets of an include.
struct Include {
  std::string target;
  bool quoted = false;
  std::size_t line = 0;
};

/// The files that people write code in (C++, CMake, scripts), ordered by path. Build folders are left out.
[[nodiscard]] std::vector<SourceFile> read_source_tree(const std::filesystem::path& root);

/// The files that people read (Markdown), ordered by path. Build folders are left out.
[[nodiscard]] std::vector<SourceFile> read_documents(const std::filesystem::path& root);

/// The files of both kinds, and all other files of text (settings, data of tests), ordered by path. Build folders are left out.
[[nodiscard]] std::vector<SourceFile> read_all_texts(const std::filesystem::path& root);

[[nodiscard]] std::vector<Include> includes_of(const SourceFile& file);

/// .hpp and .cpp
[[nodiscard]] bool is_cpp(const SourceFile& file);
/// TypeScript, or JavaScript that node runs.
[[nodiscard]] bool is_script_of_page(const SourceFile& file);

}  // namespace farlod
