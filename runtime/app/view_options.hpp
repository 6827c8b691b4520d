// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "console/run_options.hpp"
#include "view/http_server.hpp"

namespace farlod {

/// The command line of farlod-view, resolved.
struct ViewOptions {
  std::filesystem::path package;
  std::vector<std::string> results;  ///< as read_result_layer has them
  HttpServerSettings server;
  std::filesystem::path export_folder, export_page;  ///< one of them, or both, are empty
  RunOptions run;
};

/// As ParsedInfoOptions.
struct ParsedViewOptions {
  std::optional<ViewOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedViewOptions parse_view_options(int argc, char** argv);

/// Hands over the command line, from which the completions are made.
void describe_view_options(const CommandLineVisitor& visit);

}  // namespace farlod
