// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace farlod {

// What the rules read

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

// The rules of the house

/// Files whose first lines do not name the authors and the licence of their folder: GPL-3.0-or-later below preprocess/ (it
/// uses GPL packages of CGAL), Apache-2.0 elsewhere.
[[nodiscard]] std::vector<std::string> files_without_licence(const std::vector<SourceFile>& tree);

/// C++ files that are longer than 400 lines, but for those that have a reason to be.
[[nodiscard]] std::vector<std::string> files_too_long(const std::vector<SourceFile>& tree);

/// Functions of the programs whose bodies have more than 25 lines of code (comments and blank lines do not count), but for those
/// that have a reason to be longer: "path:line name has n lines". Needs the layout of clang-format. Tests may be longer.
[[nodiscard]] std::vector<std::string> functions_too_long(const std::vector<SourceFile>& tree);

/// Files whose name says nothing: utils, helpers, common, misc, manager.
[[nodiscard]] std::vector<std::string> files_with_empty_names(const std::vector<SourceFile>& tree);

/// C++ files that carry a note to do something later, which belongs into an issue.
[[nodiscard]] std::vector<std::string> files_with_notes_to_self(const std::vector<SourceFile>& tree);

/// Tests that write where another one may: only scenes::TemporaryFolder gives each its own folder, since ctest runs a test
/// beside others, and in a process of its own.
[[nodiscard]] std::vector<std::string> tests_without_own_folder(const std::vector<SourceFile>& tree);

/// Tests that measure time or resident memory, or sleep: what they find depends on what else the machine does. But for those that
/// have a reason to; they compare nothing with it.
[[nodiscard]] std::vector<std::string> tests_that_depend_on_the_machine(const std::vector<SourceFile>& tree);

/// Excuses from the rules above that excuse nothing, since the file or the function is not there any more, or keeps the rule:
/// "path", or "path name" of a function.
[[nodiscard]] std::vector<std::string> useless_excuses(const std::vector<SourceFile>& tree);

/// Lines of comments that begin with "Of": they have no subject, and a reader must guess it from the declaration. In base/,
/// include/, console/, gdal/, package/, preprocess/ and runtime/, as "path:line".
[[nodiscard]] std::vector<std::string> comments_without_subject(const std::vector<SourceFile>& tree);

/// Lines of prose in documents that have more than 120 characters: "path:line has n characters". Rows of tables may, since
/// Markdown cannot break them.
[[nodiscard]] std::vector<std::string> prose_lines_too_long(const std::vector<SourceFile>& documents);

// Who may include whom

/// Where the includes of the tree break the rules of who may know whom; one sentence each, beginning with file and line.
[[nodiscard]] std::vector<std::string> breaches_of_include_walls(const std::vector<SourceFile>& tree);

/// Exemptions from these rules that no file needs: wrappers that are not there any more or include nothing foreign, and headers
/// of the runtime that a room of preprocess may include and does not.
[[nodiscard]] std::vector<std::string> useless_exemptions(const std::vector<SourceFile>& tree);

/// Circles in the graph of folders below `side` ("preprocess/"): a folder points to another one when one of its files includes a
/// header of it. Each circle is one sentence, "a -> b -> a", and names the includes that make it.
[[nodiscard]] std::vector<std::string> include_circles(const std::vector<SourceFile>& tree, std::string_view side);

// What documents may name

/// Says whether the project has a file or folder of this path from the root.
using Exists = std::function<bool(const std::string& path)>;

/// Links of documents to what does not exist: a file, a folder, or a heading of a document. Each as `path:line target`.
/// Links to other places (`https:`) are not followed. Blocks of code and code in a line have no links.
[[nodiscard]] std::vector<std::string> dead_links(const std::vector<SourceFile>& documents, const Exists& exists);

/// What documents may name.
struct NamedTree {
  explicit NamedTree(const std::vector<SourceFile>& all_texts);

  std::set<std::string> paths;  ///< of files and folders
  std::set<std::string> words;  ///< of all texts but documents
  const std::vector<SourceFile>* texts;
};

/// What documents name as code (`so`) and the tree does not have. Each as `path:line name`.
///   (1) a path below a folder of the project, from the root or from the document; it may lack its ending, or have a `*`
///   (2) the name of a source file
///   (3) a function, `name()`, or a qualified name, `A::b`, but for those of std and CGAL
///   (4) in `name` (`file.hpp`), a name that is not in this file
/// Blocks of code are not read.
[[nodiscard]] std::vector<std::string> dead_names(const std::vector<SourceFile>& documents, const NamedTree& tree);

/// Where a version stands as a whole, not as a part of a longer number: "path:line".
[[nodiscard]] std::vector<std::string> mentions_of_version(const std::vector<SourceFile>& files, std::string_view version);

/// The version of the topmost release of a changelog in the form of keepachangelog.com ("## [1.2.3] - 2000-01-31"); empty when
/// there is none. "## [Unreleased]" is no release.
[[nodiscard]] std::string topmost_release(const SourceFile& changelog);

}  // namespace farlod
