// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "package/manifest.hpp"
#include "package/package_origin.hpp"

namespace farlod {

// What an unfinished package notes down for the process that goes on with it. A text that is none of these gives nothing: what it
// says is made anew.

[[nodiscard]] std::string record_text(const PackageOrigin& origin);
[[nodiscard]] std::optional<PackageOrigin> origin_from(const std::string& text);

[[nodiscard]] std::string record_text(const package::BlockFiles& files);
[[nodiscard]] std::optional<package::BlockFiles> block_files_from(const std::string& text);

}  // namespace farlod
