// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace farlod {

/// Markdown whose paragraphs are broken at blanks, as the documents of this project are:
///   (1) no line of a paragraph or list has more than 110 characters, unless it is a single word or code span;
///   (2) no line ends within a code span;
///   (3) rows of tables, headings and pictures stay whole;
///   (4) lines that go on with an item of a list are indented like its text.
[[nodiscard]] std::string wrapped_document(std::string_view markdown);

}  // namespace farlod
