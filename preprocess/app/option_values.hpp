// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "farlod/pack.hpp"
#include "farlod/point.hpp"

// What the texts of options mean. Each throws CLI::ValidationError where a text means nothing, and says what to give.

namespace farlod {

/// --origin: X,Y or X,Y,Z
[[nodiscard]] Point3d origin_in(const std::string& text);

/// --align: auto, none, or degrees
void set_alignment(const std::string& text, PackSettings& settings);

/// --area: a text that begins with a number and a comma is meant as a rectangle; anything else is a file.
[[nodiscard]] FarMapArea area_in(const std::string& text);

/// --shard
[[nodiscard]] Shard shard_in(const std::string& text);

/// --ground-names: separated by commas
[[nodiscard]] std::vector<std::string> names_in(const std::string& text);

}  // namespace farlod
