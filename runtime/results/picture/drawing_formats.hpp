// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "results/picture/drawing.hpp"

namespace farlod {

/// The bytes of files that show a drawing: the functions of the module `farlod_cairo`. `path` is named in errors; nothing is
/// written. All throw OutputError.
struct DrawingFormats {
  using BytesOf = std::string (*)(const Drawing& drawing, const std::filesystem::path& path);
  BytesOf png, svg, pdf;
};

}  // namespace farlod
