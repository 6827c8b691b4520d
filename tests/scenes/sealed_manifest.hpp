// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "package/manifest.hpp"

namespace farlod::scenes {

/// The text of a manifest with a checksum that is right, in the place of one that it may have. Texts that are no object of JSON
/// on several lines come back as they are.
[[nodiscard]] inline std::string sealed(std::string text) {
  constexpr std::string_view end = "\n}\n";
  if (const auto seal = package::ManifestSeal::of(text)) {
    text.resize(seal->sealed.size());
  } else {
    if (!text.ends_with(end)) return text;
    text.replace(text.size() - end.size(), end.size(), ",\n ");
  }
  return text + package::ManifestSeal::text_of(checksum_of_manifest(text));
}

}  // namespace farlod::scenes
