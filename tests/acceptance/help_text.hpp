// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace farlod::acceptance {

/// The long names at the beginnings of the lines of a help text.
[[nodiscard]] std::set<std::string> options_in(const std::string& help);

}  // namespace farlod::acceptance
