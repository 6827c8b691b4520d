// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/bundled_fonts.hpp"

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): setenv is of POSIX

#include <system_error>

namespace farlod {

std::filesystem::path bundled_font_settings(const std::filesystem::path& program) {
  std::error_code none;
  const auto settings = program.parent_path().parent_path() / "lib/farlod/share/farlod/fonts.conf";
  return std::filesystem::is_regular_file(settings, none) ? settings : std::filesystem::path();
}

void use_bundled_fonts() {
  std::error_code none;
  const auto settings = bundled_font_settings(std::filesystem::read_symlink("/proc/self/exe", none));
  // Fontconfig can be told by its environment alone. No other thread runs yet. NOLINTNEXTLINE(concurrency-mt-unsafe)
  if (!settings.empty()) setenv("FONTCONFIG_FILE", settings.c_str(), 0);
}

}  // namespace farlod
