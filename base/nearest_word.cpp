// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/nearest_word.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"

namespace farlod {
namespace {

/// The optimal string alignment distance (Damerau 1964, Levenshtein 1966).
std::size_t edits_between(std::string_view a, std::string_view b) {
  // Distances of the beginnings of `b` from those of `a` that have as many letters as this step, one less, and two less
  std::vector<std::size_t> row(b.size() + 1), before(row), before_that(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_that, before);
    std::swap(before, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({changed, before[j] + 1, row[j - 1] + 1});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before_that[j - 2] + 1);
    }
  }
  return row.back();
}

std::optional<std::string> only_one_that_begins_with(std::string_view begin, std::span<const std::string> words) {
  constexpr std::size_t least_letters = 3;
  const auto goes_on = [&](const std::string& word) { return lower_case(word).starts_with(begin); };
  if (begin.size() < least_letters || std::ranges::count_if(words, goes_on) != 1) return std::nullopt;
  return *std::ranges::find_if(words, goes_on);
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view misspelt, std::span<const std::string> words) {
  constexpr std::size_t letters_for_an_edit = 3, most_edits = 3;
  const std::string wanted = lower_case(misspelt);
  const std::size_t allowed = std::min(wanted.size() / letters_for_an_edit, most_edits);
  const auto edits = [&](const std::string& word) { return edits_between(wanted, lower_case(word)); };
  const auto nearest = std::ranges::min_element(words, {}, edits);
  if (nearest != words.end() && edits(*nearest) <= allowed) return *nearest;
  return only_one_that_begins_with(wanted, words);
}

std::string did_you_mean(std::string_view misspelt, std::span<const std::string> words) {
  const std::optional<std::string> nearest = nearest_word(misspelt, words);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace farlod
