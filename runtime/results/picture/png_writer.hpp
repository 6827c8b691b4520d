// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "results/picture/picture.hpp"

namespace farlod {

/// Writes a picture as a PNG of 8 bits a channel. Throws OutputError.
void write_png(const Picture& picture, const std::filesystem::path& path);

}  // namespace farlod
