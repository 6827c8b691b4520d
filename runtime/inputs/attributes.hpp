// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace farlod {

/// What a file says of its points besides where they are: a table of text, which goes to the output as it is.
class Attributes {
 public:
  Attributes() = default;
  explicit Attributes(std::vector<std::string> names) : names_(std::move(names)) {}

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  void rename(std::size_t column, std::string name) { names_[column] = std::move(name); }

  /// Adds the row of the next point, in the order of the names. A field that the row lacks is empty.
  void add_row(std::span<const std::string> fields);
  [[nodiscard]] std::size_t row_count() const { return names_.empty() ? 0 : ends_.size() / names_.size(); }
  [[nodiscard]] std::string_view value(std::size_t row, std::size_t column) const;

  /// The table of some of its rows.
  [[nodiscard]] Attributes rows(std::span<const std::size_t> chosen) const;

  /// What all of it takes in memory.
  [[nodiscard]] std::size_t bytes() const { return text_.size() + ends_.size() * sizeof(std::uint64_t); }

 private:
  std::vector<std::string> names_;
  std::string text_;                 // all fields, one behind the other
  std::vector<std::uint64_t> ends_;  // of each field in it
};

}  // namespace farlod
