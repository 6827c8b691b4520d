// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

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
