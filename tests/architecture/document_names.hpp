// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

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

}  // namespace farlod
