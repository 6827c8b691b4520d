// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <latch>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/library/packed_sample.hpp"
#include "view/tile_glb.hpp"
#include "view/view_city.hpp"

namespace farlod {
namespace {

using nlohmann::json;

double area_of(const TileFacet& facet) {
  const auto& [a, b, c] = facet.corners_local;
  return 0.5 * norm(cross(b - a, c - a));
}

double area_of(const TileSurfaces& surfaces) {
  double area = 0.0;
  for (const TileFacet& facet : surfaces.facets) area += area_of(facet);
  return area;
}

/// The village in cells of 50 m.
class TilesOfVillage : public testing::Test {
 protected:
  static PackSettings in_small_cells(const std::filesystem::path& folder) {
    PackSettings settings = library::village_settings(folder);
    settings.cell_edge_m = 50.0;
    return settings;
  }
  TilesOfVillage() {
    Report report;
    (void)pack(in_small_cells(folder_.path() / "village.farlod"), report);
    package_.emplace(folder_.path() / "village.farlod");
    frame_ = view_frame_of(*package_);
  }
  [[nodiscard]] TileSurfaces surfaces(const TileAddress& tile) const {
    return surfaces_of(*package_, frame_, TileTree(frame_), tile);
  }
  /// Of all that the package holds.
  [[nodiscard]] double whole_area() const {
    double area = 0.0;
    for (const MeshPart& part : geometry_of(*package_, frame_.cells))
      for (const MeshTriangle& t : part.triangles) {
        const auto& v = part.vertices_projected;
        area += 0.5 * norm(cross(v[t.vertices[1]] - v[t.vertices[0]], v[t.vertices[2]] - v[t.vertices[0]]));
      }
    return area;
  }
  template <class Visit>
  void for_each_tile(std::uint32_t level, const Visit& visit) const {
    const TileTree tree(frame_);
    for (std::uint32_t y = 0; y < 1U << level; ++y)
      for (std::uint32_t x = 0; x < 1U << level; ++x)
        if (tree.has_content({level, x, y})) visit(TileAddress{level, x, y});
  }

  scenes::TemporaryFolder folder_;
  std::optional<Package> package_;
  ViewFrame frame_;
};

TEST_F(TilesOfVillage, CellsAndTheirPartsHaveAllGeometryOnce) {
  const TileTree tree(frame_);
  for (std::uint32_t level = tree.level_of_cells(); level < tree.levels(); ++level) {
    double area = 0.0;
    for_each_tile(level, [&](const TileAddress& tile) { area += area_of(surfaces(tile)); });
    EXPECT_NEAR(area, whole_area(), 1e-6 * whole_area()) << level;
  }
}

TEST_F(TilesOfVillage, FacetsAreAsSmallAsTheErrorSays) {
  const TileTree tree(frame_);
  const std::uint32_t level = tree.levels() - 1;
  for_each_tile(level, [&](const TileAddress& tile) {
    for (const TileFacet& facet : surfaces(tile).facets)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LE(norm(facet.corners_local[(k + 1) % 3] - facet.corners_local[k]), 2.0 * tree.geometric_error_m(level) + 1e-9);
  });
}

TEST_F(TilesOfVillage, FacetsLieInTheirTileAndLookOutwards) {
  const TileTree tree(frame_);
  for_each_tile(tree.level_of_cells(), [&](const TileAddress& tile) {
    const TileSurfaces of_tile = surfaces(tile);
    for (const TileFacet& facet : of_tile.facets) {
      EXPECT_TRUE(tree.square_of(tile).contains(frame_.grid_from_local(horizontal(facet.middle_local))));
      const auto& [a, b, c] = facet.corners_local;
      EXPECT_GT(dot(facet.normal, cross(b - a, c - a)), 0.0);
      const bool is_ground = of_tile.features[facet.feature].kind == SurfaceKind::ground;
      EXPECT_TRUE(!is_ground || facet.normal.z > 0.0);
    }
  });
}

/// Otherwise parts of facets would be in none of two neighbors that are divided otherwise, and the background be seen there.
TEST_F(TilesOfVillage, TilesEndAtTheirBorders) {
  constexpr double rounding_m = 1.1e-4;  // of vertices
  const TileTree tree(frame_);
  for (std::uint32_t level = tree.level_of_cells(); level < tree.levels(); ++level)
    for_each_tile(level, [&](const TileAddress& tile) {
      const TileSquare square = tree.square_of(tile);
      for (const TileFacet& facet : surfaces(tile).facets)
        for (const Point3d& corner : facet.corners_local) {
          const Point2d p = frame_.grid_from_local(horizontal(corner)) - square.low;
          EXPECT_TRUE(std::min(p.x, p.y) >= -rounding_m && std::max(p.x, p.y) <= square.edge_m + rounding_m) << level;
        }
    });
}

TEST_F(TilesOfVillage, EachFeatureHasAFacet) {
  for (std::uint32_t level = 0; level < TileTree(frame_).levels(); ++level)
    for_each_tile(level, [&](const TileAddress& tile) {
      const TileSurfaces of_tile = surfaces(tile);
      std::vector<int> facets(of_tile.features.size());
      for (const TileFacet& facet : of_tile.facets) ++facets.at(facet.feature);
      EXPECT_EQ(std::ranges::count(facets, 0), 0) << level;
    });
}

TEST_F(TilesOfVillage, HeightsAreWithinTheFrame) {
  for (const TileFacet& facet : surfaces({}).facets)
    for (const Point3d& corner : facet.corners_local) {
      EXPECT_GE(corner.z, frame_.low_local - 1e-3);
      EXPECT_LE(corner.z, frame_.high_local + 1e-3);
    }
  EXPECT_GT(frame_.high_local, 3.0);
}

/// The mean of the vertices of the first building, half as high as they are.
Point3d middle_of_building(const Package& package, const ViewFrame& frame) {
  const std::vector<MeshPart> parts = geometry_of(package, frame.cells);
  const auto building = std::ranges::find_if(parts, [](const MeshPart& part) { return part.building.has_value(); });
  Point3d middle;
  for (const Point3d& p : building->vertices_projected)
    middle = middle + 1.0 / static_cast<double>(building->vertices_projected.size()) * p;
  return frame.local_from_projected(middle);
}

TEST_F(TilesOfVillage, ARoofThatABuildingCutsHasTheMeanOfItsFreePart) {
  constexpr double share = 0.6;  // of the way to a corner, where else its value is looked for
  const Point3d inside = middle_of_building(*package_, frame_);
  const auto value_at = [&](const Point3d& p) {
    TileSurfaces one{{}, {{"a", 1, SurfaceKind::roof}}};
    one.facets.push_back({{p, p, p}, p, {0.0, 0.0, 1.0}, 0});
    return values_of(*package_, frame_, one, azimuths_of_cells).front();
  };
  ASSERT_TRUE(std::isnan(value_at(inside)));
  Point3d free = inside;
  while (std::isnan(value_at(free))) free.x += 1.0;
  const Point3d corner = inside + 1.0 / share * (free - inside);
  TileSurfaces cut{{}, {{"a", 1, SurfaceKind::roof}}};
  cut.facets.push_back({{inside, corner, inside}, inside, {0.0, 0.0, 1.0}, 0});
  EXPECT_FLOAT_EQ(values_of(*package_, frame_, cut, azimuths_of_cells).front(), value_at(free));
  // A corner that has left the plane of the facet, as vertices of simplified tiles do, changes nothing
  cut.facets[0].corners_local[1].z += 4.0;
  EXPECT_FLOAT_EQ(values_of(*package_, frame_, cut, azimuths_of_cells).front(), value_at(free));
}

/// Facets of a wavy ground, and of roofs above it, spread evenly.
TileSurfaces spread_surfaces(const TileSquare& square, const ViewFrame& frame) {
  constexpr std::uint32_t count = 2000;
  constexpr double edge_m = 3.0, storey_m = 8.0;
  TileSurfaces surfaces{{}, {{"", 0, SurfaceKind::ground}, {"a", 1, SurfaceKind::roof}}};
  for (std::uint32_t n = 0; n < count; ++n) {
    const double turn = n * std::numbers::phi;
    const Point2d low{(square.edge_m - edge_m) * (turn - std::floor(turn)), (square.edge_m - edge_m) * n / count};
    TileFacet facet;
    facet.feature = n % 2;
    const double z = 10.0 * std::sin(0.1 * low.x) + storey_m * facet.feature;
    const std::array<Point2d, 3> corners{low, low + Point2d{edge_m, 0.0}, low + Point2d{0.0, edge_m}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point2d p = frame.local_from_grid(square.low + corners[k]);
      facet.corners_local[k] = {p.x, p.y, z};
    }
    facet.middle_local = facet.corners_local[0];
    surfaces.facets.push_back(facet);
  }
  return surfaces;
}

TEST_F(TilesOfVillage, ClustersMoveNothingByMoreThanTheError) {
  const TileSquare square{{200.0, 400.0}, 200.0};
  for (const double error_m : {1.0, 5.0, 20.0}) {
    const TileSurfaces before = spread_surfaces(square, frame_);
    TileSurfaces after = before;
    move_into_clusters(frame_, square, error_m, after);
    ASSERT_FALSE(after.facets.empty());
    std::map<std::tuple<double, double, double>, const TileFacet*> of_middle;
    for (const TileFacet& facet : before.facets)
      of_middle[{facet.middle_local.x, facet.middle_local.y, facet.middle_local.z}] = &facet;
    double largest_m = 0.0;
    for (const TileFacet& facet : after.facets) {
      const TileFacet& was = *of_middle.at({facet.middle_local.x, facet.middle_local.y, facet.middle_local.z});
      for (std::size_t k = 0; k < 3; ++k) largest_m = std::max(largest_m, norm(facet.corners_local[k] - was.corners_local[k]));
    }
    EXPECT_LE(largest_m, error_m);
    EXPECT_GT(largest_m, 0.3 * error_m) << "and they do move";
  }
}

TEST_F(TilesOfVillage, AFlatBuildingShowsItsRoof) {
  const TileSquare square{{200.0, 400.0}, 200.0};
  TileSurfaces surfaces{{}, {{"a", 1, SurfaceKind::floor}, {"a", 2, SurfaceKind::roof}, {"a", 3, SurfaceKind::floor}}};
  for (const std::uint32_t feature : {0U, 1U, 2U}) {
    TileFacet facet;
    facet.feature = feature;
    facet.normal = {0.0, 0.0, feature == 1 ? 1.0 : -1.0};
    const std::array<Point2d, 3> corners{Point2d{210.0, 410.0}, Point2d{260.0, 410.0}, Point2d{210.0, 460.0}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point2d p = frame_.local_from_grid(corners[feature == 1 ? k : 2 - k]);
      facet.corners_local[k] = {p.x, p.y, feature == 1 ? 4.0 : 0.0};
    }
    surfaces.facets.push_back(facet);
  }
  move_into_clusters(frame_, square, 20.0, surfaces);
  ASSERT_EQ(surfaces.facets.size(), 1U);
  EXPECT_EQ(surfaces.facets[0].feature, 1U);
}

TEST_F(TilesOfVillage, ClustersStayOnTheBorder) {
  const TileSquare square{{200.0, 400.0}, 200.0}, east{{400.0, 400.0}, 200.0};
  TileSurfaces one{{}, {{"", 0, SurfaceKind::ground}}}, other = one;
  TileFacet facet;
  const auto at = [&](double x, double y) {
    const Point2d p = frame_.local_from_grid({x, y});
    return Point3d{p.x, p.y, 0.0};
  };
  facet.corners_local = {at(400.0, 417.3), at(350.0, 430.0), at(400.0, 481.9)};
  one.facets = {facet};
  facet.corners_local = {at(400.0, 417.3), at(400.0, 481.9), at(450.0, 430.0)};
  other.facets = {facet};
  move_into_clusters(frame_, square, 5.0, one);
  move_into_clusters(frame_, east, 5.0, other);
  ASSERT_EQ(one.facets.size(), 1U);
  const Point3d a = one.facets[0].corners_local[0], b = other.facets[0].corners_local[0];
  EXPECT_NEAR(norm(a - b), 0.0, 1e-9);
  EXPECT_NEAR(frame_.grid_from_local(horizontal(a)).x, 400.0, 1e-9);
}

/// A GLB, read by what it says of itself.
struct Glb {
  json head;
  std::string bytes;

  explicit Glb(const std::string& file) {
    std::uint32_t length = 0, all = 0;
    std::memcpy(&all, file.data() + 8, sizeof(all));
    std::memcpy(&length, file.data() + 12, sizeof(length));
    EXPECT_EQ(all, file.size());
    EXPECT_EQ(length % 4, 0U);
    head = json::parse(file.substr(20, length));
    if (file.size() > 28 + length) bytes = file.substr(28 + length);
  }
  [[nodiscard]] std::string view(std::size_t n) const {
    const json& v = head.at("bufferViews").at(n);
    return bytes.substr(v.at("byteOffset").get<std::size_t>(), v.at("byteLength").get<std::size_t>());
  }
  [[nodiscard]] std::vector<float> floats(std::size_t primitive, const char* attribute) const {
    const json& a = head.at("meshes").at(0).at("primitives").at(primitive).at("attributes").at(attribute);
    const std::string text = view(head.at("accessors").at(a.get<std::size_t>()).at("bufferView").get<std::size_t>());
    std::vector<float> numbers(text.size() / sizeof(float));
    std::memcpy(numbers.data(), text.data(), text.size());
    return numbers;
  }
};

TileSurfaces two_facets() {
  TileSurfaces surfaces{{}, {{"", 0, SurfaceKind::ground}, {"Haus \"A\"", 7, SurfaceKind::wall}}};
  surfaces.facets.push_back({{{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0}}}, {}, {0.0, 0.0, 1.0}, 0});
  surfaces.facets.push_back({{{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 0.0, 20.0}}}, {}, {0.0, -1.0, 0.0}, 1});
  return surfaces;
}

TEST(TileGlb, HasPlacesValuesAndFeatures) {
  const Glb glb(glb_of(two_facets(), std::vector{0.25F, 0.5F}));
  ASSERT_EQ(glb.head.at("meshes").at(0).at("primitives").size(), 1U);
  EXPECT_EQ(glb.floats(0, "_SVF"), (std::vector{0.25F, 0.25F, 0.25F, 0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(glb.floats(0, "_FEATURE_ID_0"), (std::vector{0.0F, 0.0F, 0.0F, 1.0F, 1.0F, 1.0F}));
  // y up, around the middle (5, 5, 10)
  const auto moved = glb.head.at("nodes").at(0).at("translation").get<std::vector<double>>();
  EXPECT_EQ(moved, (std::vector{5.0, 10.0, -5.0}));
  const std::vector<float> places = glb.floats(0, "POSITION");
  EXPECT_EQ(std::vector(places.end() - 3, places.end()), (std::vector{5.0F, 10.0F, 5.0F})) << "(10, 0, 20)";
  const std::vector<float> ramp = glb.floats(0, "TEXCOORD_0");
  EXPECT_FLOAT_EQ(ramp[0], (0.25F * 255.0F + 0.5F) / 256.0F);
}

TEST(TileGlb, FacetsWithoutAValueAreGreyOnes) {
  const Glb glb(glb_of(two_facets(), std::vector{NAN, 0.5F}));
  const json& primitives = glb.head.at("meshes").at(0).at("primitives");
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(glb.head.at("materials").at(primitives.at(1).at("material").get<std::size_t>()).at("name"), "no data");
  EXPECT_FALSE(primitives.at(1).at("attributes").contains("_SVF"));
  EXPECT_EQ(glb.floats(1, "_FEATURE_ID_0"), std::vector(3, 0.0F));
}

TEST(TileGlb, FeaturesAreATable) {
  const Glb glb(glb_of(two_facets(), std::vector{0.25F, 0.5F}));
  const json& table = glb.head.at("extensions").at("EXT_structural_metadata").at("propertyTables").at(0);
  EXPECT_EQ(table.at("count"), 2);
  const json& building = table.at("properties").at("building");
  EXPECT_EQ(glb.view(building.at("values").get<std::size_t>()), "Haus \"A\"");
  const std::string offsets = glb.view(building.at("stringOffsets").get<std::size_t>());
  std::array<std::uint32_t, 3> begins{};
  ASSERT_EQ(offsets.size(), sizeof(begins));
  std::memcpy(begins.data(), offsets.data(), sizeof(begins));
  EXPECT_EQ(begins, (std::array<std::uint32_t, 3>{0, 0, 8}));
  EXPECT_EQ(glb.view(table.at("properties").at("kind").at("values").get<std::size_t>()), "groundwall");
}

TEST(TileGlb, NothingIsAnEmptyScene) {
  const Glb glb(glb_of({}, {}));
  EXPECT_EQ(glb.head.at("scenes"), json::array({json::object()}));
  EXPECT_FALSE(glb.head.contains("meshes"));
}

TEST(TileCache, KeepsWhatWasAskedForLast) {
  TileCache cache(250);
  int made = 0;
  const auto get = [&](std::uint32_t x) {
    return cache.get({0, x, 0}, [&] {
      ++made;
      return std::string(100, static_cast<char>('a' + x));
    });
  };
  EXPECT_EQ(*get(0), std::string(100, 'a'));
  EXPECT_EQ(*get(1), std::string(100, 'b'));
  EXPECT_EQ(*get(0), std::string(100, 'a'));
  EXPECT_EQ(made, 2);
  const auto held = get(1);
  (void)get(0);
  (void)get(2);  // 1 goes
  EXPECT_EQ(made, 3);
  (void)get(0);
  EXPECT_EQ(made, 3);
  (void)get(1);
  EXPECT_EQ(made, 4);
  EXPECT_EQ(*held, std::string(100, 'b')) << "who holds a tile keeps it";
}

TEST(TileCache, OneMakesATileForAllWhoWait) {
  TileCache cache(1000);
  constexpr int clients = 8;
  std::atomic<int> made = 0;
  std::latch all_ask(clients);
  const auto make = [&] {
    ++made;
    all_ask.wait();
    return std::string("tile");
  };
  const auto ask = [&] {
    all_ask.count_down();
    EXPECT_EQ(*cache.get({}, make), "tile");
  };
  std::vector<std::jthread> asking;
  for (int n = 0; n < clients; ++n) asking.emplace_back(ask);
  asking.clear();
  EXPECT_EQ(made, 1);
}

TEST(TileCache, AfterAFailureTheNextOneTries) {
  TileCache cache(1000);
  EXPECT_THROW((void)cache.get({}, []() -> std::string { throw std::runtime_error("damaged"); }), std::runtime_error);
  EXPECT_EQ(*cache.get({}, [] { return std::string("mended"); }), "mended");
}

TEST(TileCache, ATileLargerThanAllIsGivenToo) {
  TileCache cache(10);
  EXPECT_EQ(cache.get({}, [] { return std::string(100, 'a'); })->size(), 100U);
}

}  // namespace
}  // namespace farlod
