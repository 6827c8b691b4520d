// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "generator/city_layout.hpp"
#include "generator/generated_building.hpp"

namespace farlod {

/// All that stands on a block, and the bridges that start from it. A pure function: blocks can be made in any order.
///   (1) same settings and block, same buildings, on every machine
///   (2) ids are unique in the city, and do not depend on the rotation, the level of detail or what is added to buildings
[[nodiscard]] std::vector<GeneratedBuilding> buildings_of_block(const CitySettings& settings, CityBlock block);

/// Called with each building, and after each block with the number of blocks done.
struct CityVisitor {
  std::function<void(const GeneratedBuilding&)> building;
  std::function<void(std::int64_t)> block_done = [](std::int64_t) {};
};

/// Makes the whole city block by block, holding one block at a time. Throws SettingsError if the settings are not usable.
void visit_city(const CitySettings& settings, const CityVisitor& visitor);

/// An edge for the city such that it has about `buildings` of them (within some percent: whole blocks, counted by samples).
/// Throws SettingsError if no allowed size comes near.
[[nodiscard]] double size_for_buildings_m(CitySettings settings, std::int64_t buildings);

}  // namespace farlod
