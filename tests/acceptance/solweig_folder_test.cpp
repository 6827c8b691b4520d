// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/frame.hpp"
#include "farlod/error.hpp"
#include "farlod/shadow_patches.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/street_trees.hpp"

// What SOLWEIG reads, in one folder. Its shadow matrices are compared with rays of this file's own, against the blocks and crowns
// of the small town as they were before they were packed.

namespace farlod::acceptance {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The part of a ray that lies in a body.
struct Stretch {
  double begin = 0.0, end = 1e9;

  [[nodiscard]] Stretch within(double from, double to) const { return {std::max(begin, from), std::min(end, to)}; }
  [[nodiscard]] bool is_met() const { return begin < end; }
};

/// A ray in the town's frame.
struct TownRay {
  Point3d origin, direction;

  /// Between two planes across an axis, along which the ray begins at `p` and goes `d`.
  static Stretch between(const Stretch& s, double p, double d, double low, double high) {
    if (std::abs(d) < 1e-12) return low < p && p < high ? s : Stretch{0.0, 0.0};
    const double a = (low - p) / d, b = (high - p) / d;
    return s.within(std::min(a, b), std::max(a, b));
  }
  [[nodiscard]] Stretch in(const Block& block, double larger_m) const {
    const double half = 0.5 * block.edge_m + larger_m;
    const Stretch x = between({}, origin.x, direction.x, block.centre.x - half, block.centre.x + half);
    const Stretch y = between(x, origin.y, direction.y, block.centre.y - half, block.centre.y + half);
    return between(y, origin.z, direction.z, -1.0, block.height_m + larger_m);
  }
  /// A spheroid between two heights.
  [[nodiscard]] Stretch in_crown(Point2d axis, double radius_m, double bottom_m, double top_m) const {
    const double half = 0.5 * (top_m - bottom_m);
    const Point3d p{(origin.x - axis.x) / radius_m, (origin.y - axis.y) / radius_m, (origin.z - bottom_m - half) / half};
    const Point3d d{direction.x / radius_m, direction.y / radius_m, direction.z / half};
    const double middle = -dot(p, d) / dot(d, d), rest = middle * middle - (dot(p, p) - 1.0) / dot(d, d);
    return rest > 0.0 ? Stretch{}.within(middle - std::sqrt(rest), middle + std::sqrt(rest)) : Stretch{0.0, 0.0};
  }
};

/// What UMEP's matrices have of a ray.
struct ShadowValues {
  int building = 1, vegetation = 1, vegetation_before_building = 1;
  bool operator==(const ShadowValues&) const = default;
};

/// The same with all bodies larger or smaller by some centimetres.
ShadowValues traced(const TownRay& ray, double larger_m) {
  double solid = 1e9, crown = 1e9;
  for (const Block& block : small_town())
    if (const Stretch s = ray.in(block, larger_m); s.is_met()) solid = std::min(solid, s.begin);
  for (int n = 0; n < 20; ++n) {
    // street_trees(): 9.5 m high, trunks of a quarter of that, crowns of 6 m
    const Point2d axis{-95.0 + 10.0 * n, n % 2 == 0 ? 6.0 : -6.0};
    if (const Stretch s = ray.in_crown(axis, 3.0 + larger_m, 2.375 - larger_m, 9.5 + larger_m); s.is_met())
      crown = std::min(crown, s.begin);
  }
  const bool is_blocked = solid < 1e9, has_crown = crown < solid;
  return {is_blocked ? 0 : 1, has_crown && !is_blocked ? 0 : 1, has_crown && is_blocked ? 0 : 1};
}

/// Footprints are in whole millimetres, and floats round as much.
constexpr double grazing_m = 0.02;
constexpr double receiver_m = 1.5;

class SolweigFolder : public PackedTown {
 protected:
  SolweigFolder() {
    folder.write("trees.csv", street_trees());
    folder.must("farlod-pack town.geojson --trees trees.csv -o b.farlod --quiet");
  }
  [[nodiscard]] BytesArray matrix(const std::string& name, const std::string& of = "kit.solweig") const {
    return read_array(folder.path(of) / "shadowmats.npz", name);
  }
  [[nodiscard]] std::vector<std::string> names_in(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path(name))) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }
  [[nodiscard]] RasterFile file(const std::string& name) const { return read_raster(folder.path("kit.solweig") / name); }
};

/// Pixels of streets and crossings with their trees, and roofs.
const std::string box_of_kit = " --bbox 499900,5499940,500100,5500060 ";

TEST_F(SolweigFolder, EachPatchIsARayButWhereItGrazes) {
  folder.must("farlod-svf b.farlod -o kit.solweig --grid 2" + box_of_kit);
  const RasterFile svf = raster("kit.solweig");
  const BytesArray building = matrix("shadowmat"), vegetation = matrix("vegshadowmat"), before = matrix("vbshmat");
  std::size_t pixels = 0, compared = 0, blocked = 0, crowns = 0, crowns_before = 0;
  for (std::size_t n = 3; n < svf.values.size(); n += 19) {
    if (!svf.values[n]) continue;
    ++pixels;
    const Point2d p_town = GridRotation(town_bearing).grid_from_city(svf.centre_of(n) - town_middle);
    for (std::size_t k = 0; k < shadow_patch_count; ++k) {
      const ShadowPatch& patch = shadow_patches()[k];
      const Point2d level = GridRotation(town_bearing).grid_from_city(Point2d{sin(patch.azimuth), cos(patch.azimuth)});
      const TownRay ray{{p_town.x, p_town.y, receiver_m},
                        {cos(patch.elevation) * level.x, cos(patch.elevation) * level.y, sin(patch.elevation)}};
      const ShadowValues expected = traced(ray, 0.0);
      if (traced(ray, grazing_m) != expected || traced(ray, -grazing_m) != expected) continue;
      const ShadowValues values{building.at(n, k), vegetation.at(n, k), before.at(n, k)};
      ASSERT_EQ(values, expected) << "pixel " << n << ", patch " << k << ": " << values.building << values.vegetation
                                  << values.vegetation_before_building;
      ++compared;
      if (expected.building == 0) ++blocked;
      if (expected.vegetation == 0) ++crowns;
      if (expected.vegetation_before_building == 0) ++crowns_before;
    }
  }
  EXPECT_GE(pixels, 200U);
  EXPECT_GE(compared, 99 * pixels * shadow_patch_count / 100);
  // Each of them is met often
  EXPECT_GT(blocked, pixels);
  EXPECT_GT(crowns, pixels);
  EXPECT_GT(crowns_before, pixels);
}

TEST_F(SolweigFolder, IsOpenedByNumpyAsThatOfUmep) {
  if (folder.run("/usr/bin/python3 -c 'import numpy'").exit_code != 0) GTEST_SKIP() << "python3 has no numpy";
  folder.must("farlod-svf b.farlod -o kit.solweig --grid 4" + box_of_kit);
  folder.write("read.py",
               "import numpy\n"
               "data = numpy.load('kit.solweig/shadowmats.npz')\n"
               "print(sorted(data.keys()))\n"
               "for name in ('shadowmat', 'vegshadowmat', 'vbshmat'):\n"
               "    m = data[name]\n"
               "    print(m.dtype, m.shape, m.flags.c_contiguous, m.min(), m.max())\n");
  const Outcome read = folder.run("/usr/bin/python3 read.py");
  EXPECT_THAT(lines_of(read.out), ElementsAre("['shadowmat', 'vbshmat', 'vegshadowmat']", "uint8 (30, 50, 153) True 0 1",
                                              "uint8 (30, 50, 153) True 0 1", "uint8 (30, 50, 153) True 0 1"))
      << read.err;
}

TEST_F(SolweigFolder, HasTheShadowsAndTheSurfaceBesideTheFilesOfSvf) {
  folder.must("farlod-svf b.farlod -o kit.solweig --grid 4" + box_of_kit);
  folder.must("farlod-svf b.farlod -o svfs.zip --grid 4" + box_of_kit);
  EXPECT_THAT(names_in("kit.solweig"), ElementsAre("cdsm.tif", "dem.tif", "dsm.tif", "shadowmats.npz", "svfs.zip", "tdsm.tif",
                                                   "wall_aspect.tif", "wall_height.tif"));
  const RasterFile svf = raster("kit.solweig"), of_zip = raster("svfs.zip");
  EXPECT_EQ(svf.values, of_zip.values);
  for (const char* name : {"dsm.tif", "dem.tif", "cdsm.tif", "tdsm.tif", "wall_height.tif", "wall_aspect.tif"}) {
    const RasterFile other = file(name);
    EXPECT_EQ(other.columns, svf.columns) << name;
    EXPECT_EQ(other.rows, svf.rows) << name;
    EXPECT_EQ(other.step_m, svf.step_m) << name;
    EXPECT_EQ(other.north_west, svf.north_west) << name;
    EXPECT_EQ(other.epsg, svf.epsg) << name;
  }
}

TEST_F(SolweigFolder, HasTheHeightsOfBlocksAndCrowns) {
  folder.must("farlod-svf b.farlod -o kit.solweig --grid 1" + box_of_kit);
  const RasterFile dsm = file("dsm.tif"), dem = file("dem.tif"), cdsm = file("cdsm.tif"), tdsm = file("tdsm.tif"),
                   wall = file("wall_height.tif");
  std::size_t crowns = 0, walls = 0;
  for (std::size_t n = 0; n < dsm.values.size(); ++n) {
    const Point2d p = GridRotation(town_bearing).grid_from_city(dsm.centre_of(n) - town_middle);
    double height_m = 0.0, top_m = 0.0, bottom_m = 0.0;
    for (const Block& b : small_town()) {
      const double inside_m = 0.5 * b.edge_m - std::max(std::abs(p.x - b.centre.x), std::abs(p.y - b.centre.y));
      if (std::abs(inside_m) < grazing_m) height_m = -1.0;
      if (inside_m > grazing_m) height_m = b.height_m;
    }
    for (int k = 0; k < 20; ++k) {
      const double share = norm(p - Point2d{-95.0 + 10.0 * k, k % 2 == 0 ? 6.0 : -6.0}) / 3.0;
      if (share >= 1.0) continue;
      const double reach_m = 0.5 * (9.5 - 2.375) * std::sqrt(1.0 - share * share);
      top_m = 0.5 * (9.5 + 2.375) + reach_m;
      bottom_m = 0.5 * (9.5 + 2.375) - reach_m;
    }
    if (height_m < 0.0) continue;
    ASSERT_NEAR(dsm.values[n].value_or(-9.0), height_m, 0.001) << n;
    ASSERT_NEAR(dem.values[n].value_or(-9.0), 0.0, 0.001) << n;
    // The sides of a spheroid are steep
    ASSERT_NEAR(cdsm.values[n].value_or(-9.0), top_m, 0.2) << n;
    ASSERT_NEAR(tdsm.values[n].value_or(-9.0), bottom_m, 0.2) << n;
    if (top_m > 0.0) ++crowns;
    if (const double wall_m = wall.values[n].value_or(0.0); wall_m > 0.0) {
      ++walls;
      EXPECT_GE(wall_m, 3.0);
    }
  }
  EXPECT_GT(crowns, 300U);
  EXPECT_GT(walls, 300U);
}

TEST_F(SolweigFolder, HasWallsThatDoNotDependOnWhereTilesMeet) {
  // Tiles have 256 rows: they meet at other places of the town
  const std::string run = "farlod-svf a.farlod --grid 1 --on-surface --quiet --bbox 499950,5499820,500010,";
  folder.must(run + "5500180 -o kit.solweig");
  folder.must(run + "5500080 -o lower.solweig");
  std::size_t walls = 0;
  for (const char* name : {"wall_height.tif", "wall_aspect.tif"}) {
    const RasterFile all = file(name), part = read_raster(folder.path("lower.solweig") / name);
    ASSERT_EQ(all.rows, 360U);
    ASSERT_EQ(part.rows, 260U);
    // An aspect is made of pixels up to 4 away, and of their neighbours
    for (std::size_t n = 5 * part.columns; n < part.values.size(); ++n) {
      ASSERT_EQ(part.values[n], all.values[n + 100 * all.columns]) << name << ' ' << n;
      if (part.values[n].value_or(0.0) > 0.0) ++walls;
    }
  }
  EXPECT_GT(walls, 500U);
  const RasterFile dsm = file("dsm.tif"), wall = file("wall_height.tif");
  for (std::size_t row = 1; row + 1 < dsm.rows; ++row)
    for (std::size_t column = 1; column + 1 < dsm.columns; ++column) {
      const std::size_t n = row * dsm.columns + column;
      double highest_m = -1e9;
      for (const std::size_t other : {n - 1, n + 1, n - dsm.columns, n + dsm.columns})
        highest_m = std::max(highest_m, dsm.values[other].value_or(-1e9));
      const double height_m = highest_m - dsm.values[n].value();
      ASSERT_NEAR(wall.values[n].value(), height_m >= 3.0 ? height_m : 0.0, 1e-5) << column << ' ' << row;
    }
}

TEST_F(SolweigFolder, HasPixelsInsideBuildingsThatSeeNoSky) {
  folder.must("farlod-svf b.farlod -o kit.solweig --grid 4" + box_of_kit);
  const RasterFile svf = raster("kit.solweig");
  const BytesArray building = matrix("shadowmat"), vegetation = matrix("vegshadowmat"), before = matrix("vbshmat");
  std::size_t inside = 0;
  for (std::size_t n = 0; n < svf.values.size(); ++n) {
    if (svf.values[n]) continue;
    ++inside;
    for (std::size_t k = 0; k < shadow_patch_count; ++k) {
      ASSERT_EQ(building.at(n, k), 0);
      ASSERT_EQ(vegetation.at(n, k) + before.at(n, k), 2);
    }
  }
  EXPECT_GT(inside, 100U);
}

TEST_F(SolweigFolder, HasNoVegetationWhereThereAreNoTrees) {
  const Outcome run = folder.run("farlod-svf a.farlod -o kit.solweig --grid 4 --on-surface" + box_of_kit);
  EXPECT_EQ(run.exit_code, exit_done) << run.err;
  EXPECT_THAT(names_in("kit.solweig"),
              ElementsAre("dem.tif", "dsm.tif", "shadowmats.npz", "svfs.zip", "wall_aspect.tif", "wall_height.tif"));
  for (const char* name : {"vegshadowmat", "vbshmat"}) EXPECT_EQ(matrix(name).bytes.find('\0'), std::string::npos) << name;
  EXPECT_NE(matrix("shadowmat").bytes.find('\0'), std::string::npos);
}

TEST_F(SolweigFolder, IsTheSameForAnyNumberOfThreadsAndInShards) {
  const std::string run = "farlod-svf b.farlod --grid 4 --quiet" + box_of_kit;
  folder.must(run + "-o one.solweig --threads 1");
  folder.must(run + "-o three.solweig --threads 3");
  for (const char* shard : {"0/2", "1/2"}) folder.must(run + "-o shards.solweig --shard " + std::string(shard));
  folder.must(run + "-o shards.solweig --merge");
  for (const std::string& name : names_in("one.solweig")) {
    const std::string bytes = folder.text_of("one.solweig/" + name);
    EXPECT_EQ(bytes, folder.text_of("three.solweig/" + name)) << name;
    EXPECT_EQ(bytes, folder.text_of("shards.solweig/" + name)) << name;
  }
}

TEST_F(SolweigFolder, SaysWhatSolweigMayMiss) {
  EXPECT_THAT(folder.run("farlod-svf b.farlod -o kit.solweig --grid 8" + box_of_kit).out, HasSubstr("--on-surface"));
  folder.write("dsm.asc", ascii_grid([](Point2d p) { return norm(p) < 20.0 ? 30.0 : 10.0; }, 2.0, 60.0));
  folder.must("farlod-pack dsm.asc --crs EPSG:32632 -o c.farlod --quiet");
  const Outcome run = folder.run("farlod-svf c.farlod -o model.solweig --on-surface");
  EXPECT_EQ(run.exit_code, exit_done) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no dem.tif"));
  EXPECT_THAT(names_in("model.solweig"),
              ElementsAre("dsm.tif", "shadowmats.npz", "svfs.zip", "wall_aspect.tif", "wall_height.tif"));
}

TEST_F(SolweigFolder, ReplacesAFolderOfItsKindAndNoOther) {
  const std::string run = "farlod-svf a.farlod --grid 8 --quiet" + box_of_kit;
  folder.must(run + "-o kit.solweig");
  folder.must(run + "-o kit.solweig");
  folder.must("mkdir other.solweig && touch other.solweig/mine");
  expect_refusal(folder.run(run + "-o other.solweig"), exit_unusable_input, {"other.solweig", "no folder for SOLWEIG"});
  EXPECT_TRUE(folder.has("other.solweig/mine"));
}

}  // namespace
}  // namespace farlod::acceptance
