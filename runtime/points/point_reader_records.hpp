// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace farlod {

/// A row of a table in text, and the line on which it begins.
struct TextRecord {
  std::size_t line = 0;
  std::vector<std::string> fields;  ///< without quotes and the blanks around them
};

/// Splits a table into rows and fields. The separator is the first of tab, semicolon and comma that the first row has outside of
/// quotes. Knows quoted fields (RFC 4180), CRLF and a byte order mark; leaves out empty lines.
[[nodiscard]] std::vector<TextRecord> split_records(std::string_view text);

}  // namespace farlod
