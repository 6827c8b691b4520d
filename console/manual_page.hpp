// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "console/option_list.hpp"
#include "console/run_options.hpp"

namespace farlod {

/// Text for manual pages, which `man` shows as it stands here:
///   (1) backslashes, quotes, and dots at the beginning of a word are no commands of roff;
///   (2) the result is ASCII, whatever UTF-8 goes in.

/// A name, a command or a number, which users copy: its hyphens are the minus signs of the keyboard.
[[nodiscard]] std::string roff_literal(std::string_view text);

/// A paragraph, which ends with a line end:
///   (3) names of options and of our programs are bold, and can be copied;
///   (4) a sentence begins a line, since roff sets two blanks after a sentence that ends one;
///   (5) no line has more than 80 bytes, unless it is a single word.
[[nodiscard]] std::string roff_paragraph(std::string_view text);

/// Where a manual page comes from.
struct PageEdition {
  std::string version;
  std::string date;  ///< YYYY-MM-DD; empty: the page has none, so that the same sources make the same bytes
};

/// The page of section 1 of the manual, for `man`: it tells all that --help does.
[[nodiscard]] std::string manual_page(const ProgramDescription& program, const OptionList& options, const PageEdition& edition);

}  // namespace farlod
