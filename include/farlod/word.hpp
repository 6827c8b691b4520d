// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace farlod {

/// What the programs and Python call a value of an enum. The words of an enum stand beside it.
template <class T>
struct Word {
  std::string_view text;
  T value;
};

template <class T, std::size_t n>
[[nodiscard]] constexpr std::optional<T> value_of(const std::array<Word<T>, n>& words, std::string_view text) {
  for (const Word<T>& word : words)
    if (word.text == text) return word.value;
  return std::nullopt;
}

/// The value must have a word.
template <class T, std::size_t n>
[[nodiscard]] constexpr std::string_view word_for(const std::array<Word<T>, n>& words, T value) {
  std::size_t at = 0;
  while (words.at(at).value != value) ++at;
  return words[at].text;
}

}  // namespace farlod
