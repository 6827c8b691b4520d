// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "console/run_options.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

namespace farlod {

/// The command line of farlod-pack, resolved.
struct PackOptions {
  PackSettings settings;
  std::optional<std::uint64_t> memory_limit_mib;
  std::string report_file;
  RunOptions run;
};

/// Returns the options, or the exit code when there is nothing to do (help, version) or the command line is wrong; what
/// there is to say has been said then.
struct ParsedPackOptions {
  std::optional<PackOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedPackOptions parse_pack_options(int argc, char** argv);

/// Hands over the command line, from which the completions are made.
void describe_pack_options(const CommandLineVisitor& visit);

/// In words: "terrain".
[[nodiscard]] std::string_view name_of(GroundSource source);
/// How many buildings have no usable height or surface.
[[nodiscard]] std::size_t buildings_left_out(const Report& report);

/// The text of `--summary`, with RunOptions::settings_json.
[[nodiscard]] std::string pack_summary_json(const PackResult& result, const Report& report, double total_seconds,
                                            const std::string& settings_json);
/// The text of `--report`: every problem, one entry each.
[[nodiscard]] std::string report_json(const Report& report);
/// The same as a FeatureCollection (RFC 7946): points in WGS 84, properties as in report_json; no geometry where no place is
/// known.
[[nodiscard]] std::string report_geojson(const Report& report);

}  // namespace farlod
