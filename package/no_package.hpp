// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "farlod/error.hpp"

namespace farlod {

/// What to tell somebody who names this as a package, where no manifest is: what it is instead, such as a city file, a folder of
/// city files, a part of a package or one that is not finished, and what to name or to do.
[[nodiscard]] PackageUnusable no_package(const std::filesystem::path& name);

}  // namespace farlod
