// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <list>
#include <span>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"

namespace farlod::tiles {

/// What is wrong with a ring of a facet.
struct FacetFinding {
  ProblemCode code;
  std::size_t ring = 0;  ///< of the facet, as the city has it
  std::string detail;
  Point3d position;
};

/// The rings of a facet without spikes, which enclose nothing, and without misplaced holes, which remove nothing.
struct RepairedFacet {
  std::vector<std::span<const Point3d>> rings;  ///< the outer one first; into the city, or into `changed`
  std::list<std::vector<Point3d>> changed;
  std::vector<FacetFinding> findings;
};

/// Removes spikes from rings, removes misplaced holes, and exchanges the outer ring with a hole where the file confuses them.
/// Rings that cannot be repaired with certainty stay as they are: the triangulation reports them.
[[nodiscard]] RepairedFacet repaired_rings(const CityModel& city, const Facet& facet);

/// What a ring is called in the report: ", ring 1 (hole)".
[[nodiscard]] std::string name_of_ring(std::size_t ring);

}  // namespace farlod::tiles
