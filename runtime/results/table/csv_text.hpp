// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace farlod {

/// Text of a CSV file (RFC 4180, lines end with a line feed), written field by field and row by row.
class CsvText {
 public:
  /// Quoted, with quotes doubled, where RFC 4180 demands it.
  CsvText& field(std::string_view text);
  CsvText& whole(std::uint64_t number);
  /// As append_millimetres; empty where there is no value.
  CsvText& millimetres(double value);
  CsvText& millimetres(std::optional<double> value);
  /// As append_svf; empty where there is no answer.
  CsvText& svf(std::optional<double> value);
  /// The shortest decimal that reads back as the same number; empty where it is NaN.
  CsvText& number(float value);
  CsvText& fields(std::initializer_list<std::string_view> texts);
  void end_row();

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void begin_field();

  std::string bytes_;
  bool row_begins_ = true;
};

}  // namespace farlod
