// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <stop_token>

#include "farlod/canopy.hpp"
#include "occlusion/crown_occluder.hpp"
#include "package/package_reader.hpp"
#include "scene/near_crowns.hpp"
#include "scene/whole_city.hpp"

namespace farlod {

/// The scene of the whole city, and its crowns in the frame of that scene: each is made when it is first asked for. Threads may
/// share it.
class WholeCityOnDemand {
 public:
  const WholeCity& city(const PackageReader& package, const std::stop_token& stop) {
    std::call_once(has_city_, [&] { city_.emplace(package, stop); });
    return *city_;
  }
  /// Always of the same settings.
  const CrownOccluder& crowns(const PackageReader& package, const CanopySettings& settings, const std::stop_token& stop) {
    std::call_once(has_crowns_, [&] {
      const Grid& grid = package.grid();
      crowns_.emplace(crowns_of_whole_city(package, grid.cell_of(grid.middle_corner())), settings, stop);
    });
    return *crowns_;
  }

 private:
  std::once_flag has_city_, has_crowns_;
  std::optional<WholeCity> city_;
  std::optional<CrownOccluder> crowns_;
};

}  // namespace farlod
