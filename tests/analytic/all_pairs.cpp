// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/analytic/all_pairs.hpp"

#include <algorithm>

namespace farlod::analytic {
namespace {

/// The pairs of values that occur so far.
class SeenPairs {
 public:
  SeenPairs(std::size_t parameters, std::size_t values)
      : parameters_(parameters), values_(values), seen_(parameters * values * parameters * values) {}

  void add(const Row& row) {
    for (const std::size_t pair : pairs_of(row)) seen_[pair] = true;
  }
  [[nodiscard]] std::ptrdiff_t new_pairs(const Row& row) const {
    return std::ranges::count_if(pairs_of(row), [this](std::size_t pair) { return !seen_[pair]; });
  }

 private:
  [[nodiscard]] std::vector<std::size_t> pairs_of(const Row& row) const {
    std::vector<std::size_t> pairs;
    for (std::size_t a = 0; a < parameters_; ++a)
      for (std::size_t b = a + 1; b < parameters_; ++b)
        pairs.push_back(((a * values_ + row[a]) * parameters_ + b) * values_ + row[b]);
    return pairs;
  }

  std::size_t parameters_, values_;
  std::vector<bool> seen_;
};

}  // namespace

std::vector<Row> with_all_pairs(std::vector<Row> first, std::vector<Row> possible) {
  std::size_t values = 0;
  for (const std::vector<Row>* rows : {&first, &possible})
    for (const Row& row : *rows) values = std::max(values, *std::ranges::max_element(row) + 1);
  SeenPairs seen(possible.empty() ? 0 : possible.front().size(), values);
  for (const Row& row : first) seen.add(row);
  while (true) {
    std::erase_if(possible, [&](const Row& row) { return seen.new_pairs(row) == 0; });
    if (possible.empty()) return first;
    first.push_back(*std::ranges::max_element(possible, {}, [&](const Row& row) { return seen.new_pairs(row); }));
    seen.add(first.back());
  }
}

}  // namespace farlod::analytic
