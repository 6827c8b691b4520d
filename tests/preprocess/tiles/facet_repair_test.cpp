// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/facet_repair.hpp"

#include <gtest/gtest.h>

namespace farlod::tiles {
namespace {

using Rings = std::vector<std::vector<Point3d>>;

const std::vector<Point3d> roof{{0, 0, 5}, {10, 0, 5}, {10, 8, 5}, {0, 8, 5}}, court{{2, 2, 5}, {2, 4, 5}, {4, 4, 5}};
const std::vector<Point3d> court_with_spike{{2, 2, 5}, {2, 4, 5}, {4, 4, 5}, {6, 6, 5}, {4, 4, 5}};

struct Repair {
  CityModel city;
  RepairedFacet facet;

  explicit Repair(const Rings& rings) {
    city.begin_building("house");
    city.begin_facet(SurfaceKind::roof, 0);
    for (const auto& ring : rings) city.add_ring(ring);
    facet = repaired_rings(city, city.facets()[0]);
  }
  [[nodiscard]] Rings rings() const {
    Rings copies;
    for (const auto ring : facet.rings) copies.emplace_back(ring.begin(), ring.end());
    return copies;
  }
};

TEST(FacetRepair, LeavesGoodRingsWhereTheyAre) {
  const Repair repair({roof, court});
  EXPECT_TRUE(repair.facet.findings.empty());
  EXPECT_EQ(repair.facet.rings[1].data(), repair.city.ring(repair.city.facets()[0], 1).data());
}

TEST(FacetRepair, PutsTheOuterRingFirst) { EXPECT_EQ(Repair({court, roof}).rings(), (Rings{roof, court})); }

TEST(FacetRepair, TakesSpikesOutOfHolesToo) {
  const Repair repair({roof, court_with_spike});
  EXPECT_EQ(repair.rings()[1].size(), 3U);
  ASSERT_EQ(repair.facet.findings.size(), 1U);
  EXPECT_EQ(repair.facet.findings[0].code, ProblemCode::spike);
  EXPECT_EQ(repair.facet.findings[0].ring, 1U);
  EXPECT_EQ(repair.facet.findings[0].position, (Point3d{6, 6, 5}));
  EXPECT_EQ(repair.facet.findings[0].detail, "vertex 3 of ring 1 lies 2.828 m out on a way that is run there and back");
}

TEST(FacetRepair, CountsRingsAsTheFacetHasThem) {
  const Repair repair({roof, court, court, court});
  EXPECT_EQ(repair.rings(), (Rings{roof, court}));
  ASSERT_EQ(repair.facet.findings.size(), 2U);
  EXPECT_EQ(repair.facet.findings[1].ring, 3U);
  EXPECT_EQ(name_of_ring(3), ", ring 3 (hole)");
}

}  // namespace
}  // namespace farlod::tiles
