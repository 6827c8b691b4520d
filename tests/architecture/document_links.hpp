// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Says whether the project has a file or folder of this path from the root.
using Exists = std::function<bool(const std::string& path)>;

/// Links of documents to what does not exist: a file, a folder, or a heading of a document. Each as `path:line target`.
/// Links to other places (`https:`) are not followed. Blocks of code and code in a line have no links.
[[nodiscard]] std::vector<std::string> dead_links(const std::vector<SourceFile>& documents, const Exists& exists);

}  // namespace farlod
