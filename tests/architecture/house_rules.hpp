// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

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

}  // namespace farlod
