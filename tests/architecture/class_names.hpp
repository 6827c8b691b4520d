// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// The classes, structs, unions and enums that a file defines outside of functions and of unnamed namespaces, with their
/// namespaces and outer classes: "farlod::tiles::EdgeTable::Hash".
[[nodiscard]] std::vector<std::string> class_definitions(const SourceFile& file);

/// Qualified names with two definitions in the code that may be linked into one program: the library folders, which the tests
/// link together, and their programs. Two definitions break the one-definition rule, which no compiler reports. Each is one
/// sentence.
[[nodiscard]] std::vector<std::string> classes_defined_twice(const std::vector<SourceFile>& tree);

}  // namespace farlod
