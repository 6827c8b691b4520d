// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/grid.hpp"
#include "occlusion/occluder.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// The tiles of the neighborhood of `cell`, in the frame of `cell`. Neighbors that do not exist are empty.
[[nodiscard]] Occluder near_scene(const PackageReader& package, Cell cell);

}  // namespace farlod
