// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "tests/analytic/analytic_scenes.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::analytic {

/// One value of each parameter, by its number.
using Row = std::vector<std::size_t>;

/// Adds rows of `possible` to `first` until each pair of values of two parameters that is in a row of `possible` is in a row of
/// the result. The same rows for the same arguments. They are few: each row that is added has the most new pairs.
[[nodiscard]] std::vector<Row> with_all_pairs(std::vector<Row> first, std::vector<Row> possible);

/// How much of a scene is near; the rest is in the far map.
enum class Share { all_near, all_far, split };

/// What a scene is packed as.
struct Setup {
  Share share;
  FarMapKind kind;
  Walls walls;
  double bearing_deg;
};

/// One package.
struct Case {
  Scene scene;
  Setup setup;
};
[[nodiscard]] std::string name_of(const Case& c);
[[nodiscard]] const char* name_of(Engine engine);
inline void PrintTo(const Case& c, std::ostream* out) { *out << name_of(c); }

/// Those whose answers from a package with far maps of this kind have a closed form. Without the far city (`near_only`) there is
/// none.
[[nodiscard]] std::vector<Engine> engines_for(FarMapKind kind);

/// Every scene with every setup in which it has a known answer.
[[nodiscard]] std::vector<Case> all_cases();

/// Those of all_cases() that the tests pack: each pair of two of scene, share, kind of far map, walls and bearing that occurs in
/// all_cases(), and therefore each engine with each scene, share, kind of walls and bearing. And, since overhangs were wrong
/// near, far and split for a reason of its own each time: from each side of every overhang near, far and split, on a turned grid.
[[nodiscard]] std::vector<Case> chosen_cases();

}  // namespace farlod::analytic
