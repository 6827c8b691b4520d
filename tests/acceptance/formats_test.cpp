// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "package/package_reader.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

/// The town does not say where it lies; any projected CRS in metres will do.
constexpr const char* some_crs = " --crs EPSG:25832";
constexpr const char* reference_file = "formats/citygml20_lod2.gml";

/// What the same town may differ by between two formats.
constexpr double relative_area_tolerance = 1e-6, svf_tolerance = 1e-4;

using Areas = std::map<std::tuple<int, int, SurfaceKind>, double>;

double area_m2(const TileView& tile, const Triangle& t) {
  const auto corner = [&](std::uint32_t row) {
    const Point3f& p = tile.mesh.vertices[row];
    return Point3d{p.x, p.y, p.z};
  };
  return 0.5 * norm(cross(corner(t.b) - corner(t.a), corner(t.c) - corner(t.a)));
}

/// Of each kind of surface in each tile.
Areas areas_of(const PackageReader& package) {
  Areas areas;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    const Cell cell = cells.cell_at(n);
    const TileView tile = package.tile(cell);
    for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t)
      areas[{cell.i, cell.j, static_cast<SurfaceKind>(tile.surface_of(t).kind())}] += area_m2(tile, tile.mesh.triangles[t]);
  }
  return areas;
}

class Formats : public RealCity, public testing::WithParamInterface<const char*> {
 protected:
  void pack_as(const std::string& file, const std::string& name) const {
    folder.must("farlod-pack " + data(file) + some_crs + " --cell 25 -o " + name + ".farlod --quiet");
    folder.must("farlod-svf " + name + ".farlod -o " + name + ".asc --grid 1 --quiet");
  }
};

TEST_P(Formats, OfTheSameTownGiveTheSameTilesAndSkyViewFactors) {
  needs({reference_file, GetParam()});
  if (IsSkipped()) return;
  pack_as(reference_file, "a");
  pack_as(GetParam(), "b");
  const Areas expected = areas_of(PackageReader(folder.path("a.farlod"))),
              found = areas_of(PackageReader(folder.path("b.farlod")));
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [place, area] : expected) {
    const auto& [i, j, kind] = place;
    ASSERT_TRUE(found.contains(place)) << i << ", " << j;
    EXPECT_NEAR(found.at(place), area, relative_area_tolerance * area) << i << ", " << j << ", kind " << static_cast<int>(kind);
  }
  const RasterFile a = read_raster(folder.path("a.asc")), b = read_raster(folder.path("b.asc"));
  ASSERT_EQ(a.values.size(), b.values.size());
  std::size_t receivers = 0;
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    ASSERT_EQ(a.values[n].has_value(), b.values[n].has_value()) << n;
    if (!a.values[n]) continue;
    ++receivers;
    EXPECT_NEAR(*a.values[n], *b.values[n], svf_tolerance) << n;
  }
  EXPECT_GT(receivers, 1000U);
}

INSTANTIATE_TEST_SUITE_P(All, Formats,
                         testing::Values("formats/citygml10_lod2.gml", "formats/citygml30_lod2.gml",
                                         "formats/cityjson20_lod2.city.json", "formats/cityjsonseq.city.jsonl"));

}  // namespace
}  // namespace farlod::acceptance
