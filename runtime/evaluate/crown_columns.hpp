// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "evaluate/quantity_table.hpp"

namespace farlod {

/// The letters of the halves of the sky, and their words.
inline constexpr std::array<std::pair<const char*, const char*>, 4> words_of_halves{
    {{"N", "northern"}, {"E", "eastern"}, {"S", "southern"}, {"W", "western"}}};

// The functions of the rows of crowns (QuantityRow): what their columns are, and the values of a receiver
void describe_total(const Quantities& q, std::vector<ColumnDescription>& columns);
void add_total(const Quantities& q, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values);
void describe_svfaveg(const Quantities& q, std::vector<ColumnDescription>& columns);
void add_svfaveg(const Quantities& q, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values);
void describe_directional_vegetation(const Quantities& q, std::vector<ColumnDescription>& columns);
void add_directional_vegetation(const Quantities& q, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values);
void describe_shares(const Quantities& q, std::vector<ColumnDescription>& columns);
void add_shares(const Quantities& q, float svf, const CanopyAnswer& answer, ValuesOfReceiver& values);

}  // namespace farlod
