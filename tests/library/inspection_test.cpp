// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/inspection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "tests/library/packed_sample.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::library {
namespace {

namespace fs = std::filesystem;

constexpr double degrees = std::numbers::pi / 180.0;

std::vector<CellPlace> cells_of(const Package& package) {
  const CellRectangle all = inventory_of(package).cells;
  std::vector<CellPlace> cells;
  for (std::int32_t j = all.j_begin; j < all.j_end; ++j)
    for (std::int32_t i = all.i_begin; i < all.i_end; ++i) cells.push_back({i, j});
  return cells;
}

/// The files of that name, one in each block.
std::vector<fs::path> files_of_blocks(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == name) files.push_back(entry.path());
  EXPECT_FALSE(files.empty()) << name;
  return files;
}
std::uint64_t bytes_of_blocks(const fs::path& folder, const std::string& name) {
  std::uint64_t bytes = 0;
  for (const fs::path& file : files_of_blocks(folder, name)) bytes += fs::file_size(file);
  return bytes;
}

/// Turns a bit of a file, `share` of the way from its beginning to its end.
void damage(const fs::path& file, double share) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto place = static_cast<std::streamoff>(share * static_cast<double>(fs::file_size(file)));
  stream.seekg(place);
  const int byte = stream.get();
  stream.seekp(place);
  stream.put(static_cast<char>(byte ^ 1));
}

TEST(Inspection, HeightsAreThoseOfAllCells) {
  const PackedSample sample;
  const Package package(sample.folder());
  double low_m = 1e9, high_m = -1e9;
  for (const CellPlace cell : cells_of(package)) {
    const CellContents contents = inspect_cell(package, cell);
    if (!contents.low_m) continue;
    low_m = std::min(low_m, *contents.low_m);
    high_m = std::max(high_m, *contents.high_m);
  }
  const std::optional<HeightRange> heights = heights_of(package);
  ASSERT_TRUE(heights);
  EXPECT_EQ(heights->low_m, low_m);
  EXPECT_EQ(heights->high_m, high_m);
  EXPECT_LT(low_m, high_m);
}

TEST(Inspection, HeightsOfAFileThatIsCutShortAreDamage) {
  const PackedSample sample;
  const fs::path file = files_of_blocks(sample.folder(), "tiles.bin").front();
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THROW((void)heights_of(Package(sample.folder())), PackageDamaged);
}

TEST(Inspection, TheInventoryIsThatOfThePacking) {
  const PackedSample sample;
  const Package package(sample.folder());
  const PackageInventory inventory = inventory_of(package);
  EXPECT_EQ(inventory.format_version, 10U);
  EXPECT_EQ(static_cast<std::int64_t>(cells_of(package).size()), package.description().columns * package.description().rows);
  ASSERT_EQ(inventory.inputs.size(), 1U);
  EXPECT_EQ(inventory.inputs[0].name, "village.gml");
  EXPECT_EQ(inventory.inputs[0].bytes, fs::file_size(sample.settings().inputs[0]));
  EXPECT_EQ(inventory.tile_bytes, bytes_of_blocks(sample.folder(), "tiles.bin"));
  EXPECT_EQ(inventory.far_map_bytes, bytes_of_blocks(sample.folder(), "far.exr"));
  EXPECT_EQ(inventory.assign, "clip");
  EXPECT_GT(inventory.azimuth_bins, 0U);
  EXPECT_EQ(inventory.rows, 0U);
}

TEST(Inspection, CellsHoldTheCityTogether) {
  const PackedSample sample;
  const Package package(sample.folder());
  std::uint64_t triangles = 0;
  for (const CellPlace cell : cells_of(package)) triangles += inspect_cell(package, cell).triangles;
  EXPECT_EQ(triangles, package.description().triangles);
}

TEST(Inspection, ACellKnowsItsPlaceAndItsNeighbors) {
  const PackedSample sample;
  const Package package(sample.folder());
  const PackageDescription& d = package.description();
  const CellPlace first = cells_of(package).front();
  const CellContents contents = inspect_cell(package, first);
  const auto& corners = contents.corners_projected;
  // Counter-clockwise, along the streets
  const Point2d east = corners[1] - corners[0], north = corners[3] - corners[0];
  EXPECT_NEAR(norm(east), d.cell_edge_m, 1e-6);
  EXPECT_NEAR(std::atan2(north.x, north.y) / degrees, d.grid_bearing.degrees(), 1e-6);
  EXPECT_GT(east.x * north.y - east.y * north.x, 0.0);
  EXPECT_EQ(contents.neighborhood, (CellRectangle{first.i - 1, first.j - 1, first.i + 2, first.j + 2}));
  const auto beside = std::ranges::count_if(
      cells_of(package), [&](CellPlace c) { return std::abs(c.i - first.i) <= 1 && std::abs(c.j - first.j) <= 1; });
  EXPECT_EQ(static_cast<std::ptrdiff_t>(contents.near_cells.size()), beside);
  EXPECT_TRUE(contents.has_far_map);
  EXPECT_GT(contents.far_map_bytes, 0U);
  EXPECT_LT(contents.far_map_bytes, inventory_of(package).far_map_bytes);
}

TEST(Inspection, GeometryIsTheCityPieceByPiece) {
  const PackedSample sample;
  const Package package(sample.folder());
  const std::vector<MeshPart> parts = geometry_of(package, inventory_of(package).cells);
  std::uint64_t triangles = 0;
  std::set<std::uint32_t> numbers;
  std::set<std::string> ids;
  for (const MeshPart& part : parts) {
    triangles += part.triangles.size();
    if (part.building) {
      numbers.insert(*part.building);
      ids.insert(part.id);
    }
    for (const MeshTriangle& t : part.triangles) {
      for (const std::uint32_t v : t.vertices) ASSERT_LT(v, part.vertices_projected.size());
      const Point3d a = part.vertices_projected[t.vertices[0]], b = part.vertices_projected[t.vertices[1]];
      const double up = cross(b - a, part.vertices_projected[t.vertices[2]] - a).z;
      if (t.kind == SurfaceKind::roof || t.kind == SurfaceKind::ground) {
        EXPECT_GE(up, 0.0);
      }
      if (t.kind == SurfaceKind::floor) {
        EXPECT_LE(up, 0.0);
      }
    }
  }
  EXPECT_EQ(triangles, package.description().triangles);
  EXPECT_EQ(numbers.size(), package.description().buildings);
  EXPECT_EQ(ids.size(), package.description().buildings);
  ASSERT_FALSE(parts.empty());
  EXPECT_FALSE(parts.front().building) << "the ground comes first";
}

TEST(CheckedPackage, IsWhole) {
  for (const FarMapKind kind : {FarMapKind::horizon, FarMapKind::box}) {
    const PackedSample sample(kind);
    const Package package(sample.folder());
    for (const std::size_t threads : {1U, 3U}) {
      std::size_t done = 0, all = 0;
      RunSettings run;
      run.threads = threads;
      run.on_progress = [&](const Progress& p) {
        EXPECT_LE(done, p.done);
        done = p.done;
        all = p.all;
      };
      const PackageCheck check = check_package(package, run);
      EXPECT_TRUE(check.damage.empty());
      EXPECT_EQ(check.files, 2 * inventory_of(package).blocks + 1) << "sources.bin is one more";
      EXPECT_EQ(check.cells, cells_of(package).size());
      EXPECT_EQ(check.far_maps, cells_of(package).size());
      EXPECT_EQ(check.bytes, inventory_of(package).tile_bytes + inventory_of(package).far_map_bytes +
                                 std::filesystem::file_size(sample.folder() / "sources.bin"));
      EXPECT_EQ(done, all);
      EXPECT_EQ(all, check.bytes);
    }
  }
}

TEST(CheckedPackage, TellsOfEachFileThatIsDamaged) {
  const PackedSample sample;
  const fs::path tiles = files_of_blocks(sample.folder(), "tiles.bin").front();
  damage(tiles, 0.5);
  damage(tiles.parent_path() / "far.exr", 0.0);
  const Package package(sample.folder());
  const PackageCheck check = check_package(package);
  ASSERT_GE(check.damage.size(), 2U);
  EXPECT_TRUE(check.damage[0].file.ends_with("tiles.bin")) << check.damage[0].file;
  EXPECT_TRUE(check.damage[0].file.starts_with("blocks/")) << check.damage[0].file;
  EXPECT_TRUE(check.damage[1].file.ends_with("far.exr"));
  EXPECT_NE(check.damage[1].what.find("checksum"), std::string::npos);
  EXPECT_LT(check.cells, cells_of(package).size());
  EXPECT_GT(check.cells, 0U) << "of the other blocks";
}

TEST(CheckedPackage, TellsWhichFarMapIsDamaged) {
  const PackedSample sample;
  const Package package(sample.folder());
  // Among the pictures, whose compression has no room for a bit that means nothing
  damage(files_of_blocks(sample.folder(), "far.exr").front(), 0.9);
  const PackageCheck check = check_package(package);
  ASSERT_EQ(check.damage.size(), 2U);
  EXPECT_FALSE(check.damage[0].cell);
  ASSERT_TRUE(check.damage[1].cell);
  EXPECT_EQ(check.far_maps, cells_of(package).size() - 1);
  EXPECT_EQ(check.cells, cells_of(package).size()) << "the tiles are whole";
}

TEST(CheckedPackage, CountsTheTriangles) {
  const PackedSample sample;
  const fs::path manifest = sample.folder() / "manifest.json";
  std::string text = scenes::text_of(manifest);
  const std::string key = "\"triangles\": ";
  text.insert(text.find(key) + key.size(), "1");
  std::ofstream(manifest) << scenes::sealed(text);
  const PackageCheck check = check_package(Package(sample.folder()));
  ASSERT_EQ(check.damage.size(), 1U);
  EXPECT_EQ(check.damage[0].file, "manifest.json");
}

TEST(PackageWithTrees, TellsItsCrownsAndChecksThem) {
  const PackedSample sample;
  const PackageCheck without = check_package(Package(sample.folder()));
  EXPECT_EQ(without.crowns, 0U);
  EXPECT_EQ(inventory_of(Package(sample.folder())).crowns.all(), 0U);
  CrownsOfCity crowns = scenes::crowns_for(sample.folder());
  const Point2d middle_grid = crowns.grid().centre_of({crowns.grid().cells.i_begin, crowns.grid().cells.j_begin});
  for (const CrownShape shape : {CrownShape::prism, CrownShape::spheroid, CrownShape::prism})
    crowns.add(middle_grid, 10.0, 20.0, 3.0, shape, Foliage::unknown);
  scenes::plant(crowns, sample.folder());
  const Package package(sample.folder());
  const PackageInventory inventory = inventory_of(package);
  EXPECT_EQ(inventory.format_version, 10U);
  EXPECT_EQ(inventory.crowns.spheroids, 1U);
  EXPECT_EQ(inventory.crowns.cylinders, 0U);
  EXPECT_EQ(inventory.crowns.prisms, 2U);
  EXPECT_EQ(inventory.crowns.bytes, fs::file_size(sample.folder() / "crowns.bin"));
  const PackageCheck check = check_package(package);
  EXPECT_TRUE(check.damage.empty());
  EXPECT_EQ(check.crowns, 3U);
  EXPECT_EQ(check.files, without.files + 1);
  EXPECT_EQ(check.bytes, without.bytes + inventory.crowns.bytes);
}

TEST(PackageWithTrees, TellsThatItsCrownsAreDamaged) {
  const PackedSample sample;
  CrownsOfCity crowns = scenes::crowns_for(sample.folder());
  crowns.add(crowns.grid().centre_of({crowns.grid().cells.i_begin, crowns.grid().cells.j_begin}), 10.0, 20.0, 3.0,
             CrownShape::spheroid, Foliage::unknown);
  scenes::plant(crowns, sample.folder());
  damage(sample.folder() / "crowns.bin", 0.9);
  const PackageCheck check = check_package(Package(sample.folder()));
  ASSERT_EQ(check.damage.size(), 1U);
  EXPECT_EQ(check.damage[0].file, "crowns.bin");
  EXPECT_NE(check.damage[0].what.find("checksum"), std::string::npos);
  EXPECT_EQ(check.crowns, 0U);
  EXPECT_EQ(check.cells, cells_of(Package(sample.folder())).size()) << "the tiles are whole";
}

/// A house at the middle of UTM 32N, a tower of 100 m that stands 500 m from it in a direction of the CRS, and a low house behind
/// the tower.
class HouseAndTower {
 public:
  HouseAndTower(Point2d direction, FarMapKind kind) {
    scenes::FootprintsText town;
    for (const auto& [id, place, height_m] :
         {std::tuple("house", house, 5.0), {"tower", house + 500.0 * direction, 100.0}, {"low", house + 800.0 * direction, 6.0}})
      town.add(scenes::building(id, height_m), Box2d{place - Point2d{10, 10}, place + Point2d{10, 10}});
    std::ofstream(folder_.file("town.geojson")) << town.text();
    PackSettings settings;
    settings.inputs = {folder_.file("town.geojson")};
    settings.output = folder_.file("town.farlod");
    settings.far_map = kind;
    settings.cell_edge_m = 50.0;
    settings.align = AlignMode::fixed;
    settings.fixed_bearing = Angle::degrees(30.0);
    Report report;
    (void)pack(settings, report);
  }
  [[nodiscard]] Package open() const { return Package(folder_.file("town.farlod")); }
  /// On the central meridian, where grid north is true north.
  static constexpr Point2d house{500000.0, 5500000.0};

 private:
  scenes::TemporaryFolder folder_;
};

CellPlace cell_at(const Package& package, Point2d p) {
  for (const CellPlace place : cells_of(package)) {
    const auto corners = inspect_cell(package, place).corners_projected;
    bool inside = true;
    for (std::size_t n = 0; n < 4; ++n) {
      const Point2d side = corners[(n + 1) % 4] - corners[n], to = p - corners[n];
      inside = inside && side.x * to.y - side.y * to.x >= 0.0;
    }
    if (inside) return place;
  }
  ADD_FAILURE() << "no cell there";
  return {};
}

/// The tower is seen where it stands, whatever the map stores of it: as edges, or in the residual horizon.
TEST(FarViewOfHorizon, HasTheTowerWhereItStands) {
  for (const double azimuth_deg : {0.0, 90.0, 200.0}) {
    const Point2d direction{std::sin(azimuth_deg * degrees), std::cos(azimuth_deg * degrees)};
    const HouseAndTower town(direction, FarMapKind::horizon);
    const Package package = town.open();
    const auto view = far_view_of(package, cell_at(package, HouseAndTower::house));
    ASSERT_TRUE(view);
    const FarHorizonView& h = view->horizon;
    ASSERT_FALSE(h.low.empty());
    double highest = 0.0, where_deg = -1.0;
    for (std::size_t n = 0; n < h.low.size(); ++n) {
      EXPECT_LE(h.low[n], h.estimate[n]);
      EXPECT_LE(h.estimate[n], h.high[n]);
      if (h.estimate[n] > highest) {
        highest = static_cast<double>(h.estimate[n]);
        where_deg = h.first_azimuth.degrees() + (static_cast<double>(n) + 0.5) * 360.0 / static_cast<double>(h.low.size());
      }
    }
    // What is not worth an edge of its own lies there, too, seen from anywhere in the cell
    bool any = false;
    for (std::size_t n = 0; n < h.high.size(); ++n) {
      if (!(h.high[n] > 0.0F)) continue;
      any = true;
      const double bin_deg =
          h.first_azimuth.degrees() + (static_cast<double>(n) + 0.5) * 360.0 / static_cast<double>(h.high.size());
      EXPECT_LT(std::abs(std::remainder(bin_deg - azimuth_deg, 360.0)), 30.0) << n;
    }
    EXPECT_TRUE(any);
    for (const FarEdge& edge : h.edges)
      for (const Point3d& p : {edge.a_projected, edge.b_projected}) {
        const Point3d d = p - view->eye_projected;
        if (d.z / std::hypot(d.x, d.y) <= highest) continue;
        highest = d.z / std::hypot(d.x, d.y);
        where_deg = std::atan2(d.x, d.y) / degrees;
      }
    // The cell's middle lies within 36 m of the house, the tower's corners within 15 m of its middle
    EXPECT_NEAR(highest, 0.2, 0.04);
    EXPECT_NEAR(std::remainder(where_deg - azimuth_deg, 360.0), 0.0, 7.0) << azimuth_deg;
  }
}

TEST(FarViewOfBox, HasTheTowerOnTheSideWhereItStands) {
  // The grid is turned by 30°: its north side is seen from −15° to 75°, clockwise from there come east, south and west
  for (const auto& [azimuth_deg, side, across] : {std::tuple{30.0, 0, 0.5},
                                                  {120.0, 1, 0.5},
                                                  {210.0, 2, 0.5},
                                                  {300.0, 3, 0.5},
                                                  {10.0, 0, 0.5 * (1.0 - std::tan(20.0 * degrees))}}) {
    const Point2d direction{std::sin(azimuth_deg * degrees), std::cos(azimuth_deg * degrees)};
    const HouseAndTower town(direction, FarMapKind::box);
    const Package package = town.open();
    const auto view = far_view_of(package, cell_at(package, HouseAndTower::house));
    ASSERT_TRUE(view);
    const FarBoxView& box = view->box;
    // The middle of the two lies a little beside the meridian
    EXPECT_NEAR(box.north_azimuth.degrees(), 30.0, 0.01);
    double sum = 0.0, count = 0.0;
    const std::size_t columns = 4 * box.side_columns;
    ASSERT_EQ(box.distance_m.size(), columns * box.rows);
    for (std::size_t n = 0; n < box.distance_m.size(); ++n) {
      if (!std::isfinite(box.distance_m[n])) continue;
      EXPECT_NEAR(box.distance_m[n], 500.0, 80.0);
      sum += (static_cast<double>(n % columns) + 0.5) / static_cast<double>(box.side_columns);
      count += 1.0;
    }
    ASSERT_GT(count, 0.0);
    // The cell's middle lies within 36 m of the house
    EXPECT_NEAR(sum / count, side + across, 0.08) << azimuth_deg;
  }
}

}  // namespace
}  // namespace farlod::library
