// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace farlod::tiles {

/// Figures in messages: three digits after the point are a millimetre.
[[nodiscard]] inline std::string metres(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 4) + " m";
}

}  // namespace farlod::tiles
