// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace farlod {

/// What farlod-view did.
struct ViewSummary {
  std::uint64_t requests = 0;          ///< that were answered; 0 of an export
  std::uint64_t tiles = 0, bytes = 0;  ///< that were exported
  double open_seconds = 0.0, total_seconds = 0.0;
};

/// For programs; the keys are listed in docs/view.md.
[[nodiscard]] std::string view_summary_json(const ViewSummary& summary, const std::string& settings_json);

}  // namespace farlod
