// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace farlod::scenes {

/// What a package depends on. Where one of them differs, it is packed anew.
struct PackedFrom {
  std::string name;               ///< distinct in the build; an older package of this name is removed
  std::string text;               ///< input and settings, as far as `program` does not hold them
  std::filesystem::path program;  ///< what packs; its bytes count
};

/// The folder, below the build, of what `pack` writes into the folder that it is given. Each test runs in a process of its own:
/// those that find no folder pack, and the folder of the first that is done is the one that all get. It must not be changed.
/// `pack` returns whether it is done; where it is not, this throws and nothing is kept.
[[nodiscard]] std::filesystem::path packed_once(const PackedFrom& from,
                                                const std::function<bool(const std::filesystem::path&)>& pack);

/// The test program that runs, for packages that it packs itself.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace farlod::scenes
