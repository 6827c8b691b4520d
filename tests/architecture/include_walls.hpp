// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Where the includes of the tree break the rules of who may know whom; one sentence each, beginning with file and line.
[[nodiscard]] std::vector<std::string> breaches_of_include_walls(const std::vector<SourceFile>& tree);

}  // namespace farlod
