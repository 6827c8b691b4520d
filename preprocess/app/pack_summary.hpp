// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

namespace farlod {

/// The text of `--summary`, with RunOptions::settings_json.
[[nodiscard]] std::string pack_summary_json(const PackResult& result, const Report& report, double total_seconds,
                                            const std::string& settings_json);
/// The text of `--report`: every problem, one entry each.
[[nodiscard]] std::string report_json(const Report& report);
/// The same as a FeatureCollection (RFC 7946): points in WGS 84, properties as in report_json; no geometry where no place is
/// known.
[[nodiscard]] std::string report_geojson(const Report& report);

}  // namespace farlod
