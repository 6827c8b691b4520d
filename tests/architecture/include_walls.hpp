// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Where the includes of the tree break the rules of who may know whom; one sentence each, beginning with file and line.
[[nodiscard]] std::vector<std::string> breaches_of_include_walls(const std::vector<SourceFile>& tree);

/// Exemptions from these rules that no file needs: wrappers that are not there any more or include nothing foreign, and headers
/// of the runtime that a room of preprocess may include and does not.
[[nodiscard]] std::vector<std::string> useless_exemptions(const std::vector<SourceFile>& tree);

}  // namespace farlod
