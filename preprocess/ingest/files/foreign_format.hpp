// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// A format of cities, drawings or meshes that is not read.
struct ForeignFormat {
  std::string_view name;    ///< "a DXF drawing"
  std::string_view advice;  ///< what makes a file of it that is read
};

/// The format of a file by its content, or by its name where the content has no mark; null where it is none of them.
[[nodiscard]] const ForeignFormat* foreign_format_of(const InputFile& file);

/// What ends the run: that `file` is of this format, and what converts it.
[[nodiscard]] std::string refusal_of(const InputFile& file, const ForeignFormat& format);

}  // namespace farlod::ingest
