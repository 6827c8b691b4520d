// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "farlod/error.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// What a word means. Throws InvalidArgument, which lists the words that there are.
template <class T, std::size_t n>
T meaning_of(const char* name, const std::string& word, const std::array<Word<T>, n>& words) {
  if (const std::optional<T> value = value_of(words, word)) return *value;
  std::string list;
  for (const Word<T>& known : words) list.append(list.empty() ? "\"" : ", \"").append(known.text).append("\"");
  throw InvalidArgument(std::string(name) + " is \"" + word + "\": give one of " + list);
}

}  // namespace farlod
