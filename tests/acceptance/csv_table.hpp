// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace farlod::acceptance {

/// A table that farlod-svf wrote. None of the tests' names needs quotes.
class CsvTable {
 public:
  explicit CsvTable(const std::string& text);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const std::vector<std::string>& header() const { return header_; }
  /// Fails the test when there is no such column or row.
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  /// The sum of a column by the values of others.
  [[nodiscard]] std::map<std::string, double> sums_by(const std::vector<std::string>& columns, const std::string& summed) const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace farlod::acceptance
