// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "console/wrong_usage.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// Checks that an option is one of the words of an enum, but for those of values that the program does not offer.
template <class T, std::size_t n, class... Left>
[[nodiscard]] CLI::Validator one_of(const std::array<Word<T>, n>& words, Left... left_out) {
  std::vector<std::string> offered;
  for (const Word<T>& word : words)
    if (((word.value != left_out) && ...)) offered.emplace_back(word.text);
  return one_of_words(offered);
}

}  // namespace farlod
