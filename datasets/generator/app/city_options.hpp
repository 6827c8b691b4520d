// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "console/program_description.hpp"
#include "console/run_options.hpp"
#include "generator/city_settings.hpp"
#include "generator/city_writer.hpp"

namespace farlod {

struct CityOptions {
  CitySettings settings;
  std::filesystem::path output;
  CityFormat format = CityFormat::obj;
  bool obj_from_centre = false;
  std::filesystem::path trees;  ///< empty: none are written
  RunOptions run;
};

/// The options, or the exit code after --help, --version or an error that was printed.
struct ParsedCityOptions {
  std::optional<CityOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedCityOptions parse_city_options(int argc, char** argv);

/// Hands over the command line, from which the manual page and the completion are made.
void describe_city_options(const CommandLineVisitor& visit);

}  // namespace farlod
