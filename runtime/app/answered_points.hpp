// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "app/named_points.hpp"
#include "app/svf_options.hpp"
#include "farlod/package.hpp"
#include "farlod/points.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// Throws NoAnswer where no point lies within answered_beyond_grid_m of the grid: says where the first is, and where the city is.
/// Throws PointsError where the first lies nowhere on Earth.
void require_any_in_reach(const NamedPoints& named, const SvfOptions& options, const PackageDescription& city);

/// Throws NoAnswer where no point has an answer: says where the first in reach is, and why it has none; outside of the city also
/// where that is.
void require_answers_of_points(const NamedPoints& named, const Reasons& reasons, const PointAnswers& answers,
                               const SvfOptions& options, const PackageDescription& city);

/// What to tell of a place of --at that is answered outside of all cells.
[[nodiscard]] std::optional<std::string> note_outside_of_grid(const NamedPoints& named, const PointAnswers& answers,
                                                              const SvfOptions& options, const PackageDescription& city);

/// What to tell of points that lie farther away, beside others: how many, and which is the first. Notes of `named` tell of those
/// that are far from the city.
[[nodiscard]] std::optional<std::string> note_of_points_beyond(const NamedPoints& named, const PackageDescription& city);

/// How many points lie below the ground outside of buildings. Inside of them, no height above the ground has an answer, either.
[[nodiscard]] std::size_t count_below_open_ground(const Reasons& reasons);

/// What to tell of heights whose column may also mean heights above the ground, with what of the points speaks for that.
[[nodiscard]] std::optional<std::string> note_of_heights(const NamedPoints& named, const Reasons& reasons,
                                                         const PackageDescription& city);

/// Why points have no answer. Of many, the first are looked at one by one.
[[nodiscard]] Reasons reasons_of_unanswered(const Package& package, const NamedPoints& named, const PointAnswers& answers,
                                            std::size_t threads);

/// What to tell of points that have a place in reach and no answer: the first of them, and why.
[[nodiscard]] std::optional<std::string> note_of_unanswered(const NamedPoints& named, const Reasons& reasons,
                                                            const PackageDescription& city);

/// Evaluates the points that have a place in reach; the others have no answer. Throws PointsError for a point that is none, since
/// it is of an input, and what the library throws.
[[nodiscard]] PointAnswers evaluate_named(const Package& package, const NamedPoints& named, const SvfOptions& options,
                                          const RunSettings& run);

}  // namespace farlod
