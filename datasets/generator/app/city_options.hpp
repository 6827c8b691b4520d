// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "console/run_options.hpp"
#include "generator/city_settings.hpp"
#include "generator/city_writer.hpp"

namespace farlod {

struct CityOptions {
  CitySettings settings;
  std::filesystem::path output;
  CityFormat format = CityFormat::obj;
  bool obj_from_centre = false;
  RunOptions run;
};

/// The options, or the exit code after --help, --version or an error that was printed.
struct ParsedCityOptions {
  std::optional<CityOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedCityOptions parse_city_options(int argc, char** argv);

}  // namespace farlod
