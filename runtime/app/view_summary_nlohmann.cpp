// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "app/view_summary.hpp"
#include "console/run_program.hpp"

namespace farlod {

std::string view_summary_json(const ViewSummary& summary, const std::string& settings_json) {
  using Json = nlohmann::ordered_json;
  const Json json = {{"requests", summary.requests},
                     {"tiles", summary.tiles},
                     {"bytes", summary.bytes},
                     {"seconds", {{"total", summary.total_seconds}, {"open", summary.open_seconds}}},
                     {"peak_memory_mib", peak_memory_mib()},
                     {"settings", Json::parse(settings_json)}};
  return json.dump(1) + "\n";
}

}  // namespace farlod
