// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace farlod {

/// The settings of Fontconfig that an archive or a wheel brings along, for a program that lies in its folder bin; empty for a
/// program without.
[[nodiscard]] std::filesystem::path bundled_font_settings(const std::filesystem::path& program);

/// Lets this program draw texts with the font that was brought along, on systems that may have none, unless FONTCONFIG_FILE names
/// other settings. In main(), before any other thread is.
void use_bundled_fonts();

}  // namespace farlod
