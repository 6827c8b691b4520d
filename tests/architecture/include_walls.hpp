// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Where the includes of the tree break the rules of who may know whom; one sentence each, beginning with file and line.
[[nodiscard]] std::vector<std::string> breaches_of_include_walls(const std::vector<SourceFile>& tree);

/// Exemptions from these rules that no file needs: wrappers that are not there any more or include nothing foreign, and headers
/// of the runtime that a room of preprocess may include and does not.
[[nodiscard]] std::vector<std::string> useless_exemptions(const std::vector<SourceFile>& tree);

/// Circles in the graph of folders below `side` ("preprocess/"): a folder points to another one when one of its files includes a
/// header of it. Each circle is one sentence, "a -> b -> a", and names the includes that make it.
[[nodiscard]] std::vector<std::string> include_circles(const std::vector<SourceFile>& tree, std::string_view side);

}  // namespace farlod
