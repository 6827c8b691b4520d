// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "farlod/error.hpp"
#include "package/package_reader.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/real_city.hpp"
#include "tests/scenes/mesh_files.hpp"

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

/// The village, whose faces are convex, as triangles about an origin near it, so that float has their corners.
constexpr Point3d village_origin{549947.0, 5499959.0, 0.0};

scenes::TriangleMesh village_as_triangles() {
  scenes::TriangleMesh mesh;
  std::ifstream file(std::filesystem::path(FARLOD_SOURCE_DIR) / "datasets/samples/village.obj");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    Point3d p;
    if (keyword == "v" && words >> p.x >> p.y >> p.z) mesh.vertices.push_back(p - village_origin);
    if (keyword != "f") continue;
    std::uint32_t first = 0, last = 0, next = 0;
    for (words >> first >> last; words >> next; last = next) mesh.triangles.push_back({first - 1, last - 1, next - 1});
  }
  return mesh;
}

/// Float moves corners by 8 µm at the most. Where that takes a corner from one of the 320 azimuths to the next, a receiver sees
/// past it there; elsewhere it is nothing beside a wall that is half a metre away.
constexpr double one_azimuth = 1.0 / 320.0, mean_tolerance = 8e-6 / 0.5;

TEST(MeshFormats, OfTheSameVillageGiveTheSameSkyViewFactors) {
  const WorkFolder folder;
  const scenes::TriangleMesh village = village_as_triangles();
  folder.write("a.obj", scenes::obj_of(village));
  folder.write("text.stl", scenes::stl_text_of(village));
  folder.write("binary.stl", scenes::stl_of(village));
  folder.write("a.ply", scenes::ply_of(village, false));
  folder.write("a.glb", scenes::glb_of(village));
  const auto map_of = [&](const std::string& file) {
    folder.must("farlod-pack " + file + " -o a.farlod --force --quiet --crs EPSG:32632 --origin 549947,5499959");
    folder.must("farlod-svf a.farlod -o a.asc --grid 2 --quiet");
    return read_raster(folder.path("a.asc"));
  };
  const RasterFile expected = map_of("a.obj");
  EXPECT_GT(std::count_if(expected.values.begin(), expected.values.end(), [](const auto& v) { return v && *v < 0.9; }), 500);
  for (const char* file : {"text.stl", "binary.stl", "a.ply", "a.glb"}) {
    const RasterFile found = map_of(file);
    ASSERT_EQ(found.values.size(), expected.values.size()) << file;
    double sum = 0.0;
    for (std::size_t n = 0; n < found.values.size(); ++n) {
      ASSERT_EQ(found.values[n].has_value(), expected.values[n].has_value()) << file << ' ' << n;
      if (!found.values[n]) continue;
      ASSERT_NEAR(*found.values[n], *expected.values[n], one_azimuth) << file << ' ' << n;
      sum += std::abs(*found.values[n] - *expected.values[n]);
    }
    EXPECT_LT(sum / static_cast<double>(found.values.size()), mean_tolerance) << file;
  }
}

TEST(MeshFormats, NamesOfGroundAreTheUsersToo) {
  const WorkFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 0 0 9\no Gel\xC3\xA4nde_1\nf 1 2 3\no house\nf 1 2 4\nf 2 3 4\n");
  const Outcome outcome = folder.run(
      "farlod-pack --ground-names 'gel\xC3\xA4nde, lot' a.obj -o a.farlod --crs EPSG:32632 --origin 549947,5499959 --summary "
      "a.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, testing::HasSubstr("ground by their names: 1 of gel\xC3\xA4nde"));
  EXPECT_THAT(outcome.out + outcome.err, testing::HasSubstr("nothing is called lot"));
  EXPECT_EQ(folder.json_of("a.json").at("buildings"), 1);
}

/// The system in which the buildings' places are compared, by receivers at the same whole metres.
constexpr const char* same_place = " --crs EPSG:6697 --out-crs EPSG:6677 --align none --quiet";
constexpr const char* exactly = " --grid 1 --engine exact --rays 1000 --quiet";
/// Two towns are not cut alike, so that of a receiver's rays one may graze an edge here and there.
constexpr double two_rays = 2.0 / 1000.0;

const std::string clean_town = "tokyo/53392633_bldg_6697_2_op.gml";

/// A copy of a CityGML file with one of its buildings only.
std::string with_one_building(const std::string& file, const std::string& id) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  const std::string all = std::move(text).str(), begin = "<core:cityObjectMember>", end = "</core:cityObjectMember>";
  const std::size_t wanted = all.find("\"" + id + "\""), from = all.rfind(begin, wanted), to = all.find(end, wanted) + end.size();
  return all.substr(0, all.find(begin)) + all.substr(from, to - from) + all.substr(all.rfind(end) + end.size());
}

/// A damaged copy of the town, or of one building of it.
struct Damage {
  const char* file;
  const char* only_building;  ///< of which there are damaged copies, and nothing else
  std::vector<int> codes;     ///< that are reported because of the damage, besides other levels of detail
};
void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.file; }

class RepairedTowns : public RealCity, public testing::WithParamInterface<Damage> {
 protected:
  void pack(const std::string& file, const std::string& package) const {
    folder.must("farlod-pack " + file + same_place + " -o " + package + " --report " + package + ".json");
  }
  /// The map on the ground, or on top of whatever stands there.
  [[nodiscard]] RasterFile map_of(const std::string& package, const char* where) const {
    folder.must("farlod-svf " + package + " -o " + package + ".asc " + where + exactly);
    return read_raster(folder.path(package + ".asc"));
  }
  void expect_same(const RasterFile& clean, const RasterFile& repaired) const {
    ASSERT_EQ(clean.values.size(), repaired.values.size());
    for (std::size_t n = 0; n < clean.values.size(); ++n) {
      ASSERT_EQ(clean.values[n].has_value(), repaired.values[n].has_value()) << n;
      if (clean.values[n]) {
        EXPECT_NEAR(*clean.values[n], *repaired.values[n], two_rays) << n;
      }
    }
  }
};

/// What was damaged in these files is hidden by the rest of its building, or is a copy of what is sound, or lies nowhere in town:
/// so that the repaired town has the sky of the clean one everywhere, not only far from the damage.
TEST_P(RepairedTowns, HaveTheSkyOfTheCleanTown) {
  const std::string damaged = data(std::string("broken/") + GetParam().file);
  needs({clean_town, std::string("broken/") + GetParam().file});
  if (IsSkipped()) return;
  std::string clean = data(clean_town);
  if (*GetParam().only_building != '\0') {
    folder.write("one.gml", with_one_building(clean, GetParam().only_building));
    clean = "one.gml";
  }
  pack(clean, "clean");
  pack(damaged, "repaired");
  for (const char* where : {"", "--on-surface"}) expect_same(map_of("clean", where), map_of("repaired", where));
  std::set<int> codes;
  for (const nlohmann::json& entry : folder.json_of("repaired.json")) codes.insert(entry.at("code").get<int>());
  for (const int code : GetParam().codes) EXPECT_TRUE(codes.contains(code)) << code;
}

INSTANTIATE_TEST_SUITE_P(All, RepairedTowns,
                         testing::Values(Damage{"invalid.gml", "", {207}}, Damage{"L13.gml", "", {105, 207}},
                                         Damage{"C01_C04_L05_L06_L07_L11_L13_T03_invalid_demo.gml",
                                                "bldg_1290f570-9df8-4956-bef3-6d0976c835be",
                                                {105, 204, 207}}));

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A package that opens, or one line that says why there is none.
void expect_package_or_one_clear_error(const WorkFolder& folder, const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  // Each takes a second or less. What has not ended by then never will, however busy the machine is
  const Outcome outcome = folder.run("timeout 600 farlod-pack " + file + " " + options + " -o a.farlod --force --quiet");
  if (outcome.exit_code == exit_done) {
    EXPECT_EQ(outcome.err, "");
    return folder.must("farlod-svf a.farlod -o a.asc --grid 5 --quiet");
  }
  EXPECT_EQ(outcome.exit_code, exit_unusable_input) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_EQ(lines.size(), 1U) << outcome.err;
  EXPECT_THAT(lines.front(), testing::StartsWith("farlod-pack: "));
  EXPECT_THAT(lines.front(), testing::HasSubstr(std::filesystem::path(file).filename().string()));
}

class StrangeFiles : public RealCity, public testing::WithParamInterface<const char*> {};

TEST_P(StrangeFiles, GiveAPackageOrOneClearError) {
  needs({GetParam()});
  if (IsSkipped()) return;
  const std::vector<std::string> files = files_in(data(GetParam()));
  EXPECT_GT(files.size(), 5U);
  for (const std::string& file : files) {
    expect_package_or_one_clear_error(folder, file, "");
    expect_package_or_one_clear_error(folder, file, "--crs EPSG:25832 --default-height 10");
  }
}

INSTANTIATE_TEST_SUITE_P(Folders, StrangeFiles, testing::Values("formats", "broken"));

}  // namespace
}  // namespace farlod::acceptance
