// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "console/run_options.hpp"
#include "farlod/inspection.hpp"

namespace farlod {

/// The command line of farlod-info, resolved.
struct InfoOptions {
  std::filesystem::path package;
  bool json = false, check = false;
  std::optional<CellPlace> cell;
  std::filesystem::path obj_file, picture_file;  ///< of the cell, or the picture of the city; perhaps empty
  std::filesystem::path cells_file;              ///< of the table of cells; perhaps empty
  std::filesystem::path zones_file;              ///< of polygons that take the place of cells there; perhaps empty
  std::string zones_layer;                       ///< of that file; perhaps empty
  std::optional<double> sky_spacing_m;           ///< of the receivers whose sky view factors that table has
  std::filesystem::path report_file;             ///< of problems, for the picture of the city; perhaps empty
  RunOptions run;
};

/// The options, or the exit code when there is nothing to do (help, version) or the command line is wrong; what there is
/// to say has been said then.
struct ParsedInfoOptions {
  std::optional<InfoOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedInfoOptions parse_info_options(int argc, char** argv);

/// Hands over the command line, from which the completions are made.
void describe_info_options(const CommandLineVisitor& visit);

}  // namespace farlod
