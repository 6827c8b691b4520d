// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ingest/mesh/mesh.hpp"

namespace farlod::ingest {

/// The faces of each building of a mesh, one building after the other.
struct FacesOfBuildings {
  std::span<const std::uint32_t> faces;
  std::span<const std::size_t> begin;  ///< of each building in `faces`, and one past the last
};

/// Finds the buildings that are ground, whatever they are called. One is where
///   (1) it has no walls: less than a tenth of its area is steeper than 78°;
///   (2) it lies once over the plan: its faces cover no more than the box around them;
///   (3) at least three others stand within that box, which are half of all others or more;
///   (4) most of them rise above it: its corner that is nearest to their middle in the plan is lower than that middle.
[[nodiscard]] std::vector<std::size_t> find_ground_sheets(const Mesh& mesh, UpAxis up, const FacesOfBuildings& buildings);

}  // namespace farlod::ingest
