// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/facet_repair.hpp"

#include <algorithm>
#include <utility>

#include "tiles/metres_text.hpp"
#include "tiles/misplaced_holes.hpp"
#include "tiles/spikes.hpp"

namespace farlod::tiles {
namespace {

void remove_spikes(RepairedFacet& facet) {
  for (std::size_t k = 0; k < facet.rings.size(); ++k) {
    auto despiked = without_spikes(facet.rings[k]);
    if (!despiked) continue;
    for (const Spike& spike : despiked->spikes)
      facet.findings.push_back({ProblemCode::spike, k,
                                "vertex " + std::to_string(spike.vertex) + " of ring " + std::to_string(k) + " lies " +
                                    metres(spike.length_m) + " out on a way that is run there and back",
                                spike.tip});
    facet.rings[k] = facet.changed.emplace_back(std::move(despiked->ring));
  }
}

void sort_holes(RepairedFacet& facet) {
  const RingPlaces places = places_of_rings(facet.rings);
  for (const MisplacedHole& hole : places.misplaced)
    facet.findings.push_back(
        {ProblemCode::hole_outside, hole.ring, std::string(hole.reason) + ", and was left out", facet.rings[hole.ring].front()});
  if (places.true_outer)
    facet.findings.push_back({ProblemCode::self_intersecting, *places.true_outer,
                              "a hole surrounds the outer ring: the two were exchanged",
                              facet.rings[*places.true_outer].front()});
  std::vector<bool> is_misplaced(facet.rings.size(), false);
  for (const MisplacedHole& hole : places.misplaced) is_misplaced[hole.ring] = true;
  std::vector<std::span<const Point3d>> kept;
  for (std::size_t k = 0; k < facet.rings.size(); ++k)
    if (!is_misplaced[k]) kept.insert(k == places.true_outer ? kept.begin() : kept.end(), facet.rings[k]);
  facet.rings = std::move(kept);
}

}  // namespace

RepairedFacet repaired_rings(const CityModel& city, const Facet& facet) {
  RepairedFacet repaired;
  for (std::uint32_t k = 0; k < facet.ring_count; ++k) repaired.rings.push_back(city.ring(facet, k));
  remove_spikes(repaired);
  if (repaired.rings.size() > 1) sort_holes(repaired);
  return repaired;
}

std::string name_of_ring(std::size_t ring) { return ", ring " + std::to_string(ring) + (ring == 0 ? " (outer)" : " (hole)"); }

}  // namespace farlod::tiles
