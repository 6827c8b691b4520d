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

[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// The first of tab, semicolon and comma that a row has outside of quotes; a comma where it has none.
[[nodiscard]] char separator_of(std::string_view row);

/// Splits a table into rows and fields. Knows quoted fields (RFC 4180) and CRLF; leaves out empty lines.
[[nodiscard]] std::vector<TextRecord> split_records(std::string_view text, char separator);

}  // namespace farlod
