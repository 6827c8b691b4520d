// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace farlod {

/// Where a version stands as a whole, not as a part of a longer number: "path:line".
[[nodiscard]] std::vector<std::string> mentions_of_version(const std::vector<SourceFile>& files, std::string_view version);

/// The version of the topmost release of a changelog in the form of keepachangelog.com ("## [1.2.3] - 2000-01-31"); empty when
/// there is none. "## [Unreleased]" is no release.
[[nodiscard]] std::string topmost_release(const SourceFile& changelog);

}  // namespace farlod
