// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// A word that the project no longer uses, and the term of docs/glossary.md that replaces it.
///   (1) between backticks it is an identifier, and is found where it stands as a whole in code, not in comments
///   (2) otherwise it is a phrase, and is found in names and in prose, however it is written: "unnamed city" also in UnnamedCity
///       and unnamed_city
struct RetiredWord {
  std::string word, use_instead;
  bool is_identifier = false;
};

/// The lines of retired_words.txt. Throws std::runtime_error where there are none, or where one is not "word | term".
[[nodiscard]] std::vector<RetiredWord> read_retired_words(const std::filesystem::path& list);

/// "path:line: word -> term" for each retired word in a file.
[[nodiscard]] std::vector<std::string> find_retired_words(const std::vector<SourceFile>& files,
                                                          const std::vector<RetiredWord>& words);

/// The words of a line in lower case, parted by single blanks, with one before and behind: of names, too.
[[nodiscard]] std::string words_of(std::string_view line);

/// The classes, structs, unions and enums that a file defines outside of functions and of unnamed namespaces, with their
/// namespaces and outer classes: "farlod::tiles::EdgeTable::Hash".
[[nodiscard]] std::vector<std::string> class_definitions(const SourceFile& file);

/// Qualified names with two definitions in the code that may be linked into one program: the library folders, which the tests
/// link together, and their programs. Two definitions break the one-definition rule, which no compiler reports. Each is one
/// sentence.
[[nodiscard]] std::vector<std::string> classes_defined_twice(const std::vector<SourceFile>& tree);

}  // namespace farlod
