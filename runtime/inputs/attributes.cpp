// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/attributes.hpp"

namespace farlod {

void Attributes::add_row(std::span<const std::string> fields) {
  for (std::size_t column = 0; column < names_.size(); ++column) {
    if (column < fields.size()) text_ += fields[column];
    ends_.push_back(text_.size());
  }
}

std::string_view Attributes::value(std::size_t row, std::size_t column) const {
  const std::size_t n = row * names_.size() + column;
  const std::size_t begin = n == 0 ? 0 : ends_[n - 1];
  return std::string_view(text_).substr(begin, ends_[n] - begin);
}

Attributes Attributes::rows(std::span<const std::size_t> chosen) const {
  Attributes result(names_);
  std::vector<std::string> fields(names_.size());
  for (const std::size_t row : chosen) {
    for (std::size_t column = 0; column < names_.size(); ++column) fields[column] = value(row, column);
    result.add_row(fields);
  }
  return result;
}

}  // namespace farlod
