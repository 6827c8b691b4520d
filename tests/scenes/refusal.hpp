// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace farlod::scenes {

/// What work says that ends with an exception of this type; "no refusal" of work that ends well.
template <class Exception, class Work>
[[nodiscard]] std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const Exception& exception) {
    return exception.what();
  }
  return "no refusal";
}

}  // namespace farlod::scenes
