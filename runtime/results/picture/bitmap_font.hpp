// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "results/picture/picture.hpp"

namespace farlod {

/// How large (each dot of a letter is a square of `scale` pixels) and in which colour.
struct TextStyle {
  std::size_t scale = 1;
  Colour colour;
};

/// The room that a line of text takes. Letters are 5 dots wide and 7 high (9 with what hangs below the line), one dot apart.
[[nodiscard]] PixelSize text_size(std::string_view text, const TextStyle& style);

/// Writes a line of text. Letters that the font does not have (it has those of English, digits and a few signs) become blanks.
void draw_text(Picture& picture, Pixel upper_left, std::string_view text, const TextStyle& style);

}  // namespace farlod
