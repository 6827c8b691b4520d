// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>

#include "city/city_model.hpp"

namespace farlod {

/// Distinct surfaces over all buildings: what users call polygons.
[[nodiscard]] inline std::uint64_t surface_count(const CityModel& city) {
  std::uint64_t count = 0;
  for (const Building& b : city.buildings()) {
    std::set<std::uint32_t> surfaces;
    for (const Facet& f : city.facets_of(b)) surfaces.insert(f.surface);
    count += surfaces.size();
  }
  return count;
}

}  // namespace farlod
