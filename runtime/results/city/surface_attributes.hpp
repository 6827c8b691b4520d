// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Names and decimal numbers. What has no answer, or was not asked for, is not among them.
using CityAttributes = std::vector<std::pair<std::string, std::string>>;

/// The names that attributes of surfaces, and those of buildings, may have.
[[nodiscard]] std::vector<std::string> attribute_names_of_surfaces(const AnswerColumns& columns);
[[nodiscard]] std::vector<std::string> attribute_names_of_buildings(const AnswerColumns& columns);

/// Of one surface of a city file that is made of these: means are weighted by area, areas are added. Of a single one, the numbers
/// are those of its row in the table of surfaces.
[[nodiscard]] CityAttributes attributes_of(std::span<const SurfaceMean* const> surfaces, const AnswerColumns& columns);

/// The numbers of its row in the table of buildings. Areas of roofs (walls) are left out where no roof (wall) has a receiver.
[[nodiscard]] CityAttributes attributes_of(const BuildingMean& building, const AnswerColumns& columns);

/// Of a part of a building that has these surfaces.
[[nodiscard]] BuildingMean mean_of(std::span<const SurfaceMean* const> surfaces);

}  // namespace farlod
