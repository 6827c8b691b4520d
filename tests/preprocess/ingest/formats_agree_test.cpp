// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "reading.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

/// A town that does not depend on the order of its buildings: for each its surfaces, as sorted corners, with their kind.
using Surface = std::pair<std::vector<std::array<double, 3>>, SurfaceKind>;

std::vector<std::vector<Surface>> town_of(const CityModel& city) {
  std::vector<std::vector<Surface>> town;
  for (const Building& building : city.buildings()) {
    std::vector<Surface>& surfaces = town.emplace_back();
    for (const Facet& facet : city.facets_of(building)) {
      Surface& surface = surfaces.emplace_back();
      surface.second = facet.kind;
      for (const Point3d& p : city.ring(facet, 0)) surface.first.push_back({p.x, p.y, p.z});
      std::sort(surface.first.begin(), surface.first.end());
    }
    std::sort(surfaces.begin(), surfaces.end());
  }
  std::sort(town.begin(), town.end());
  return town;
}

class FormatsAgree : public testing::TestWithParam<const char*> {};

TEST_P(FormatsAgree, OnTheSameTown) {
  FARLOD_NEEDS_DATA(std::string("formats/") + GetParam());
  const Reading reference = read_file(shared_data("formats/citygml20_lod2.gml"));
  const Reading other = read_file(shared_data(std::string("formats/") + GetParam()));
  EXPECT_EQ(reference.city().buildings().size(), 100u);
  EXPECT_EQ(surface_count(reference.city()), 700u);
  EXPECT_TRUE(other.codes().empty());
  EXPECT_EQ(town_of(reference.city()), town_of(other.city()));
}

INSTANTIATE_TEST_SUITE_P(Formats, FormatsAgree,
                         testing::Values("citygml10_lod2.gml", "citygml30_lod2.gml", "cityjson20_lod2.city.json",
                                         "cityjsonseq.city.jsonl"));

}  // namespace
}  // namespace farlod::ingest::test
