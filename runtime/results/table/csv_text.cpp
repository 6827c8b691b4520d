// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/csv_text.hpp"

#include <cmath>

#include "results/decimal.hpp"

namespace farlod {

void CsvText::begin_field() {
  if (!row_begins_) bytes_ += ',';
  row_begins_ = false;
}

CsvText& CsvText::field(std::string_view text) {
  begin_field();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    bytes_ += text;
    return *this;
  }
  bytes_ += '"';
  for (const char c : text) {
    if (c == '"') bytes_ += '"';
    bytes_ += c;
  }
  bytes_ += '"';
  return *this;
}

CsvText& CsvText::whole(std::uint64_t number) {
  begin_field();
  append_whole(bytes_, number);
  return *this;
}

CsvText& CsvText::millimetres(double value) {
  begin_field();
  append_millimetres(bytes_, value);
  return *this;
}

CsvText& CsvText::millimetres(std::optional<double> value) {
  if (value) return millimetres(*value);
  begin_field();
  return *this;
}

CsvText& CsvText::svf(std::optional<double> value) {
  begin_field();
  if (value) append_svf(bytes_, *value);
  return *this;
}

CsvText& CsvText::number(float value) {
  begin_field();
  if (!std::isnan(value)) bytes_ += shortest_decimal(value);
  return *this;
}

CsvText& CsvText::fields(std::initializer_list<std::string_view> texts) {
  for (const std::string_view text : texts) field(text);
  return *this;
}

void CsvText::end_row() {
  bytes_ += '\n';
  row_begins_ = true;
}

}  // namespace farlod
