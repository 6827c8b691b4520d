// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "generator/city_layout.hpp"
#include "generator/generated_building.hpp"

namespace farlod {

/// The buildings of a block, and the bridges that start from it. A pure function: blocks can be made in any order.
///   (1) same settings and block, same buildings, on every machine
///   (2) ids are unique in the city; they depend neither on the rotation nor on the level of detail nor on added features
[[nodiscard]] std::vector<GeneratedBuilding> buildings_of_block(const CitySettings& settings, CityBlock block);

/// Called with each building, and after each block with the number of blocks done.
struct CityVisitor {
  std::function<void(const GeneratedBuilding&)> building;
  std::function<void(std::int64_t)> block_done = [](std::int64_t) {};
};

/// Makes the whole city, with one block at a time in memory. Throws InvalidArgument if the settings cannot be used.
void visit_city(const CitySettings& settings, const CityVisitor& visitor);

/// The edge of a city with about `buildings` buildings, to some percent: cities consist of whole blocks, and the number is
/// estimated from samples. Throws InvalidArgument if no allowed size has about as many.
[[nodiscard]] double size_for_buildings_m(CitySettings settings, std::int64_t buildings);

}  // namespace farlod
