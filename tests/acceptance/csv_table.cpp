// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/csv_table.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

}  // namespace

CsvTable::CsvTable(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) throw std::runtime_error("the table is empty");
  header_ = fields_of(lines[0]);
  for (std::size_t n = 1; n < lines.size(); ++n) {
    rows_.push_back(fields_of(lines[n]));
    if (rows_.back().size() != header_.size())
      throw std::runtime_error("a row has not as many fields as the header: " + lines[n]);
  }
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) throw std::runtime_error("the table has no column " + column);
  return rows_.at(row)[static_cast<std::size_t>(found - header_.begin())];
}

double CsvTable::number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }

std::map<std::string, double> CsvTable::sums_by(const std::vector<std::string>& columns, const std::string& summed) const {
  std::map<std::string, double> sums;
  for (std::size_t row = 0; row < size(); ++row) {
    std::string key;
    for (const std::string& column : columns) key.append(text(row, column)).append("/");
    sums[key] += number(row, summed);
  }
  return sums;
}

}  // namespace farlod::acceptance
