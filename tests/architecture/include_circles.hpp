// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Circles in the graph of folders below `side` ("preprocess/"): a folder points to another one when one of its files includes a
/// header of it. Each circle is one sentence, "a -> b -> a", and names the includes that make it.
[[nodiscard]] std::vector<std::string> include_circles(const std::vector<SourceFile>& tree, std::string_view side);

}  // namespace farlod
