// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "farlod/problem.hpp"
#include "pipeline/pack.hpp"

namespace farlod {

/// The text of `--summary`.
[[nodiscard]] std::string pack_summary_json(const PackResult& result, const Report& report, double total_seconds);
/// The text of `--report`: every problem, one entry each.
[[nodiscard]] std::string report_json(const Report& report);

}  // namespace farlod
