// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "city/city_model.hpp"
#include "ingest/ring_cleaning.hpp"

namespace farlod {

/// Finds polygons that a building has already. The same are those of one part whose rings have the same corners the same way
/// round, wherever they begin; the two sides of a wall differ.
class WrittenPolygons {
 public:
  /// The facet of `city` that is the same polygon, among those remembered; else remembers it as the facet that the city gets
  /// next.
  [[nodiscard]] std::optional<std::uint64_t> find_or_remember(const CityModel& city, const Rings& rings, std::uint16_t part);

 private:
  std::unordered_multimap<std::uint64_t, std::uint64_t> facets_by_hash_;
};

}  // namespace farlod
