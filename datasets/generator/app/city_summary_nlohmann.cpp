// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "console/run_program.hpp"
#include "generator/app/city_options.hpp"

namespace farlod {

std::string city_summary_json(const CityOptions& options, const CityCounts& counts) {
  const nlohmann::ordered_json summary = {{"buildings", counts.buildings},
                                          {"polygons", counts.polygons},
                                          {"towers", counts.towers},
                                          {"bridges", counts.bridges},
                                          {"trees", counts.trees},
                                          {"tallest_m", counts.tallest_m},
                                          {"size_m", options.settings.size_m},
                                          {"seconds", {{"total", counts.seconds}}},
                                          {"peak_memory_mib", peak_memory_mib()},
                                          {"output_bytes", counts.bytes}};
  return summary.dump(1) + "\n";
}

}  // namespace farlod
