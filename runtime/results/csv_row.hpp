// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace farlod {

/// A field of a CSV file: quoted, with doubled quotes, where RFC 4180 demands it.
[[nodiscard]] std::string csv_field(std::string_view text);

/// Writes a row, quoting what needs it.
void write_csv_row(std::ostream& out, const std::vector<std::string>& fields);

}  // namespace farlod
