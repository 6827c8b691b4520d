// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "console/option_list.hpp"
#include "console/program_description.hpp"

namespace farlod {

/// Where a manual page comes from.
struct PageEdition {
  std::string version;
  std::string date;  ///< YYYY-MM-DD; empty: the page has none, so that the same sources make the same bytes
};

/// The page of section 1 of the manual, for `man`: it tells all that --help does.
[[nodiscard]] std::string manual_page(const ProgramDescription& program, const OptionList& options, const PageEdition& edition);

}  // namespace farlod
