// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "package/manifest.hpp"

namespace farlod {

/// From what a package is made: whatever decides its bytes. Two runs of the same origin make the same package.
struct PackageOrigin {
  struct Input {
    std::string name;
    package::FileStamp stamp;
    /// What comes through a pipe has no stamp before it was read: it is another one each time.
    bool is_known = true;
    bool is_beside = false;  ///< read together with an input, and not one itself
    // Where the file was, and when it was last written: who finds it the same need not read it. Not compared.
    std::string path = {};
    std::int64_t written_ns = 0;
  };

  std::string software;
  std::vector<Input> inputs;
  /// Options that were given, and their values, in a fixed order.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// The first difference, for people: "the input town.gml has changed", "--cell was 150, and is 100"; empty if there is none.
[[nodiscard]] std::string difference(const PackageOrigin& was, const PackageOrigin& is);

}  // namespace farlod
