// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/library/packed_sample.hpp"

namespace farlod::library {

PackedSample::PackedSample(FarMapKind far_map) : settings_(village_settings(folder_.path() / "village.farlod")) {
  settings_.far_map = far_map;
  Report report;
  result_ = pack(settings_, report);
}

Point2d middle_of(const Package& package) {
  const auto& [low, high] = package.description().outline_projected;
  return {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
}

PackSettings village_settings(const std::filesystem::path& output) {
  PackSettings settings;
  settings.inputs = {std::filesystem::path(FARLOD_SOURCE_DIR) / "datasets/samples/village.gml"};
  settings.output = output;
  return settings;
}

}  // namespace farlod::library
