// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace farlod {

/// The word that a misspelt one is meant to be. Letters in capitals count as others do. None where no word is near:
///   (1) it takes at most one edit for each three letters, and three at the most. An edit puts a letter in, leaves one out,
///       changes one, or swaps two neighbours;
///   (2) or else it is the only word that goes on where the misspelt one, of three letters or more, ends.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view misspelt, std::span<const std::string> words);

/// What a message ends with: "; did you mean grid?". Empty where no word is near.
[[nodiscard]] std::string did_you_mean(std::string_view misspelt, std::span<const std::string> words);

}  // namespace farlod
