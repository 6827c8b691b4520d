// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace farlod {

/// A file of the page that viewer/ makes, as it lies in the program.
struct BundleFile {
  std::string_view name, type, bytes;
};

/// All of them; the first one is the page itself, index.html.
[[nodiscard]] std::span<const BundleFile> bundle_files();

}  // namespace farlod
