// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/files_of_run.hpp"

#include <array>

#include "console/named_files.hpp"

namespace farlod {

void require_outputs(const SvfOptions& o) {
  const char* const of_points = o.source == ReceiverSource::lines ? "--along" : "--points";
  const std::array<NamedFile, 5> inputs{{{of_points, o.points_file},
                                         {"--grid-like", o.grid_like},
                                         {"--mask", o.mask_file},
                                         {"--city", o.city_file},
                                         {"--weather", o.light ? o.light->weather_file : std::filesystem::path()}}};
  const bool is_folder = o.city_is_folder() || (o.format != nullptr && o.format->is_folder);
  const std::array<NamedOutput, 7> outputs{{{{"-o", o.output}, is_folder},
                                            {{"--preview", o.preview_file}},
                                            {{"--verify-map", o.verify_file}},
                                            {{"--histogram", o.histogram_file}},
                                            {{"--matrix", o.matrix_file}},
                                            {{"--energyplus", o.energyplus_file}},
                                            {{"--summary", o.run.summary_file}}}};
  require_writable(outputs, {inputs, o.package});
}

}  // namespace farlod
