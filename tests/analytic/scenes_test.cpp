// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "evaluate/sky_evaluator.hpp"
#include "horizon/certain_sky.hpp"
#include "package/package_folder.hpp"
#include "receivers/receiver.hpp"
#include "scene/vertical_profile.hpp"
#include "tests/analytic/analytic_scenes.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/setups.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tiles/tiles.hpp"

// Scenes with a known answer go the whole way, from facets to a package and back: with all of their geometry near, all of it in
// the far map, and some of it in each; with walls that are mere sheets and with houses that stand; on all engines, with far maps
// of both kinds; on grids that are turned three ways. Each case is one package, asked in all ways that answer from it. Each pair
// of these values occurs, not the whole product (setups.hpp; the tests of Setups count).

namespace farlod::analytic {
namespace {

using analytic::Case;
using analytic::eye_m;
using analytic::ground;
using analytic::Scene;
using analytic::Setup;
using analytic::Share;
using analytic::Stage;
using analytic::Walls;
using scenes::SceneBuilder;
using testing::IsEmpty;
using testing::IsSubsetOf;
using testing::UnorderedElementsAre;

constexpr std::size_t rays = 200000, azimuths = 4096;

FarMapSettings maps_of(FarMapKind kind) { return kind == FarMapKind::box ? scenes::box_maps(256, 256) : FarMapSettings{}; }

bool asks_for_horizons(Engine engine) { return engine == Engine::automatic || engine == Engine::horizon; }

/// The edge of a cell that holds all, nothing or some of the scene around its middle: a corner is √½ of the edge away.
double cell_edge_for(const Scene& scene, Share share) {
  switch (share) {
    case Share::all_near:
      return 3.0 * scene.farthest_m;
    case Share::all_far:
      return 1.2 * scene.nearest_m;
    case Share::split:
      break;
  }
  return 2.0 * std::sqrt(scene.nearest_m * scene.farthest_m);
}

CityModel city_of(const Scene& scene, Walls walls, double cell_edge_m, const GridRotation& rotation) {
  const Point2d middle_city = rotation.city_from_grid(Point2d{0.5 * cell_edge_m, 0.5 * cell_edge_m});
  SceneBuilder builder({middle_city.x, middle_city.y, eye_m});
  Stage stage(builder, walls);
  scene.build(stage);
  // A stone under the eye: it says where the ground is, and that the cell exists
  builder.add_box({{-0.05, -0.05}, {0.05, 0.05}}, ground, ground + 0.01);
  return builder.city();
}

/// A scene on disk, and the receiver in the middle of its cell.
class PackedScene {
 public:
  PackedScene(const Scene& scene, const Setup& setup) : package_(packed(scene, setup)) {
    const auto half = static_cast<float>(0.5 * package_.grid().cell_edge_m);
    const Point3d n = package_.grid().rotation.grid_from_city(scene.normal);
    receiver_ = {{0, 0},
                 {{0,
                   {half, half, static_cast<float>(eye_m - package_.manifest().height_origin_m)},
                   {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}}}};
  }
  struct Svf {
    double estimate, low, high;
  };
  [[nodiscard]] Svf evaluate(Engine engine, SkyWeight weight, std::optional<double> allowed_error = std::nullopt) const {
    std::vector<float> estimate(1), low(1), high(1);
    SkyEvaluator(package_, {engine, weight, rays, allowed_error, DirectionSet::partition, azimuths})
        .evaluate(receiver_, SkyAnswers(estimate, low, high));
    return {estimate[0], low[0], high[0]};
  }
  [[nodiscard]] const PackageReader& package() const { return package_; }

 private:
  PackageReader packed(const Scene& scene, const Setup& setup) const {
    const double cell_edge_m = exact_cell_edge_m(cell_edge_for(scene, setup.share));
    const Angle bearing = Angle::degrees(setup.bearing_deg);
    const CityModel city = city_of(scene, setup.walls, cell_edge_m, GridRotation(bearing));
    const Grid grid = scenes::grid_covering(city, bearing, cell_edge_m, 1, 1);
    scenes::pack_city(city, grid, folder_.path() / "scene.farlod", maps_of(setup.kind), Assign::clip, {{Cell{0, 0}}});
    return PackageReader(folder_.path() / "scene.farlod");
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
  CellReceivers receiver_;
};

/// The border of the sky is no longer than the circle twice over: once along the horizon, once up and down its jumps.
double allowed_sampling(const Scene& scene) { return sampling_error(rays, 4 * std::numbers::pi) + scene.extra_error; }

/// The mean of a function over the circle, from the middles of equal parts, errs in each part by its variation there at the most:
/// altogether by the total variation over their number. What an azimuth gives changes with tan β by at most `steepest` (by 2
/// where the receiver is tilted: twice the cosine to its normal), and with the normal twice from nothing to all: at most 1 + π/2
/// (1).
double azimuth_error_of(const Scene& scene, SkyWeight weight) {
  const bool is_tilted = scene.normal.z < 1.0, is_cosine = weight == SkyWeight::cosine;
  const double steepest = is_cosine ? (is_tilted ? 2.0 : steepest_cos) : steepest_solid;
  const double all = is_cosine ? 1.0 + 0.5 * std::numbers::pi : 1.0;
  return (steepest * scene.rise + (is_tilted ? 2.0 * all : 0.0)) / static_cast<double>(azimuths) + scene.extra_error;
}

/// Where rays stand in for a horizon, theirs is the error.
double allowed_error(const Scene& scene, Engine engine, SkyWeight weight) {
  const double by_rays = allowed_sampling(scene);
  return asks_for_horizons(engine) ? std::max(by_rays, azimuth_error_of(scene, weight)) : by_rays;
}

/// What the estimate of a far map may lead an answer astray, which is measured and not derived.
constexpr double far_map_error = 0.01;

class AnalyticScene : public testing::TestWithParam<Case> {
 protected:
  void expect_known(Engine engine, SkyWeight weight, double expected) const {
    const double svf = packed_.evaluate(engine, weight).estimate;
    double tolerance = allowed_error(scene_, engine, weight);
    if (engine == Engine::rays || asks_for_horizons(engine)) tolerance += far_map_error;
    if (engine == Engine::rays && setup_.kind == FarMapKind::box && setup_.share != Share::all_near)
      tolerance += box_map_error(packed_.package().box_far_map({0, 0}).shape(), scene_.rise,
                                 weight == SkyWeight::cosine ? steepest_cos : steepest_solid);
    EXPECT_NEAR(svf, expected, tolerance);
  }

  void expect_bounds(Engine engine, SkyWeight weight, double expected) const {
    const auto [estimate, low, high] = packed_.evaluate(engine, weight);
    EXPECT_LE(low, estimate);
    EXPECT_LE(estimate, high);
    // A lower border shorter than the contacts of surfaces, 2 cm, may be none: so much of the turn, 4 m away
    constexpr double contact = 0.02 / (2.0 * std::numbers::pi * 4.0);
    const double slack = scene_.extra_error + (scene_.is_overhead ? contact : 0.0);
    EXPECT_LE(low, expected + slack);
    EXPECT_GE(high, expected - slack);
    // Only what is far, or overhangs, leaves much open
    if (setup_.share == Share::all_near && !scene_.is_overhead) {
      EXPECT_LE(high - low, wanted_width + 2.0 * rounding_of_bounds);
    }
    // No error is allowed: all is decided
    EXPECT_NEAR(packed_.evaluate(engine, weight, 0.0).estimate, expected, slack + 2.0 * rounding_of_bounds);
  }

  void expect_answer(Engine engine, SkyWeight weight) const {
    const double expected = weight == SkyWeight::cosine ? scene_.svf_cos : scene_.svf_solid;
    if (std::isnan(expected)) return;
    expect_known(engine, weight, expected);
    if (setup_.kind == FarMapKind::horizon) expect_bounds(engine, weight, expected);
  }

  const Scene& scene_ = GetParam().scene;
  const analytic::Setup& setup_ = GetParam().setup;
  const PackedScene packed_{scene_, setup_};
};

TEST_P(AnalyticScene, HasItsKnownSkyViewFactor) {
  for (const Engine engine : analytic::engines_for(setup_.kind))
    for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle}) {
      SCOPED_TRACE(std::string(analytic::name_of(engine)) + (weight == SkyWeight::cosine ? ", cosine" : ", solid angle"));
      expect_answer(engine, weight);
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, AnalyticScene, testing::ValuesIn(analytic::chosen_cases()),
                         [](const auto& chosen) { return analytic::name_of(chosen.param); });

// The chosen cases stand in for a product of all parameters. What they owe to it is counted here by name, by nothing of the code
// that chooses.

std::string walls_of(const Setup& setup) { return setup.walls == Walls::houses ? "houses" : "sheets"; }
std::string share_of(const Setup& setup) { return std::array{"near", "far", "split"}.at(static_cast<std::size_t>(setup.share)); }

/// Each value with its parameter, the engine among them.
std::vector<std::vector<std::string>> named_values(const std::vector<Case>& cases) {
  std::vector<std::vector<std::string>> rows;
  for (const Case& c : cases)
    for (const Engine engine : engines_for(c.setup.kind))
      rows.push_back({"scene " + c.scene.name, "share " + share_of(c.setup), "walls " + walls_of(c.setup),
                      std::string("far maps ") + scenes::name_of(c.setup.kind), std::string("engine ") + name_of(engine),
                      "bearing " + std::to_string(c.setup.bearing_deg)});
  return rows;
}

std::set<std::string> pairs_in(const std::vector<Case>& cases) {
  std::set<std::string> pairs;
  for (const std::vector<std::string>& values : named_values(cases))
    for (const std::string& a : values)
      for (const std::string& b : values)
        if (a < b) pairs.insert(a + ", " + b);
  return pairs;
}

TEST(Setups, EachPairOfTwoValuesIsPacked) {
  const std::set<std::string> wanted = pairs_in(all_cases()), packed = pairs_in(chosen_cases());
  EXPECT_GT(wanted.size(), 200U) << "there is nothing to miss";
  EXPECT_THAT(wanted, IsSubsetOf(packed));
}

/// So that a value which is missing in the product is noticed, too.
TEST(Setups, EachValueIsInTheProduct) {
  std::set<std::string> values;
  for (const std::vector<std::string>& row : named_values(all_cases())) values.insert(row.begin(), row.end());
  std::set<std::string> scenes;
  for (const Scene& scene : all_scenes()) scenes.insert("scene " + scene.name);
  EXPECT_THAT(scenes, IsSubsetOf(values));
  std::erase_if(values, [&](const std::string& value) { return scenes.contains(value); });
  EXPECT_THAT(values,
              UnorderedElementsAre("share near", "share far", "share split", "walls sheets", "walls houses", "far maps Horizon",
                                   "far maps Box", "engine automatic", "engine horizon", "engine rays", "engine exact",
                                   "bearing 0.000000", "bearing 17.000000", "bearing 45.000000"));
}

TEST(Setups, EveryOverhangIsPackedNearFarAndSplit) {
  std::set<std::string> packed;
  for (const Case& c : chosen_cases()) packed.insert(name_of(c));
  for (const Scene& scene : all_scenes()) {
    if (!scene.is_overhead) continue;
    for (const char* share : {"Near", "Far", "Split"}) EXPECT_TRUE(packed.contains(scene.name + share + "HorizonSheets17"));
  }
}

TEST(Setups, ChosenCasesAreFewAndDiffer) {
  const std::vector<Case> chosen = chosen_cases();
  std::set<std::string> names;
  for (const Case& c : chosen) names.insert(name_of(c));
  EXPECT_EQ(names.size(), chosen.size());
  EXPECT_LT(chosen.size(), all_cases().size() / 5);
}

TEST(AllPairs, KeepTheFirstRowsAndAddWhatTheyLack) {
  const std::vector<Row> possible{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_THAT(with_all_pairs({{0, 1, 1}}, possible),
              testing::ElementsAre(Row{0, 1, 1}, Row{0, 0, 0}, Row{1, 0, 1}, Row{1, 1, 0}));
}

TEST(AllPairs, ARowThatIsNotPossibleIsNotAdded) {
  const std::vector<Row> possible{{0, 0}, {1, 1}};
  EXPECT_EQ(with_all_pairs({}, possible), possible);
  EXPECT_THAT(with_all_pairs({}, {}), IsEmpty());
}

// Oracle 10: the error of the paper's map has a closed form where a wall stands on the border of the neighborhood and the
// receiver is half a cell nearer to it than the capture point. The map must show exactly that error, no more and no less.

struct Parallax {
  double cell_m;
  int neighborhood;
  double H;
};

class PaperMap : public testing::TestWithParam<Parallax> {};

TEST_P(PaperMap, IsWrongByParallaxAsItShouldBe) {
  const auto [c, N, H] = GetParam();
  constexpr double eye_m = 1.5;
  constexpr std::size_t rays = 200000;
  const double D = 0.5 * N * c, middle = 0.5 * c, a = 10 * D;
  scenes::SceneBuilder builder;
  builder.add_wall({middle + D, middle - a}, {middle + D, middle + a}, 0.0, H + eye_m);
  builder.add_box({{middle - 0.05, middle - 0.05}, {middle + 0.05, middle + 0.05}}, 0.0, 0.01);
  const Grid grid = scenes::grid_covering(builder.city(), {}, c, N, 1);
  const scenes::TemporaryFolder folder;
  const FarMapSettings map_settings = scenes::box_maps(256, 256);
  scenes::pack_city(builder.city(), grid, folder.path() / "scene.farlod", map_settings, Assign::clip, {{Cell{0, 0}}});
  const PackageReader package(folder.path() / "scene.farlod");
  // The receiver is in the same cell, as near to the wall as the cell lets it be
  const CellReceivers receiver{{0, 0}, {{0, {std::nextafter(static_cast<float>(c), 0.0F), static_cast<float>(middle), eye_m}}}};
  std::vector<float> map(1), exact(1);
  SkyEvaluator(package, {Engine::rays, SkyWeight::cosine, rays}).evaluate(receiver, map);
  SkyEvaluator(package, {Engine::exact, SkyWeight::cosine, rays}).evaluate(receiver, exact);
  const double sampling = sampling_error(rays, 4 * std::numbers::pi);
  const double map_error = box_map_error(package.box_far_map({0, 0}).shape(), 2 * H / D, steepest_cos);
  EXPECT_NEAR(exact[0], oracles::finite_wall_cos(H, D - c / 2, a, a), sampling);
  EXPECT_NEAR(map[0], oracles::finite_wall_cos(H, D, a, a), sampling + map_error);
}

INSTANTIATE_TEST_SUITE_P(All, PaperMap, testing::Values(Parallax{50, 3, 50}, Parallax{100, 3, 50}));

// A row of houses along a slope that climbs to the east by a fifth, with one level floor: it touches the ground at its uphill
// side, and floats 2 m over the ground at its downhill side.

constexpr double climb = 0.2, floor_m = 2.0, roof_m = 8.0, depth_m = 10.0, half_length_m = 200.0;

TerrainRaster slope() {
  TerrainRaster terrain;
  terrain.first = {-100.0, -250.0};
  terrain.step_m = {10.0, 10.0};
  terrain.columns = 21;
  terrain.rows = 51;
  for (std::size_t row = 0; row < terrain.rows; ++row)
    for (std::size_t column = 0; column < terrain.columns; ++column)
      terrain.height_m.push_back(static_cast<float>(climb * terrain.node(column, row).x));
  return terrain;
}

void add_box(CityModel& city, const std::string& id, Point2d low, Point2d high, double bottom_m, double top_m) {
  const std::array plan{low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}};
  const auto at = [&plan](std::size_t k, double z) { return Point3d{plan[k % 4].x, plan[k % 4].y, z}; };
  city.begin_building(id);
  city.begin_facet(SurfaceKind::floor, 0);
  city.add_ring(std::array{at(3, bottom_m), at(2, bottom_m), at(1, bottom_m), at(0, bottom_m)});
  city.begin_facet(SurfaceKind::roof, 1);
  city.add_ring(std::array{at(0, top_m), at(1, top_m), at(2, top_m), at(3, top_m)});
  for (std::uint32_t k = 0; k < 4; ++k) {
    city.begin_facet(SurfaceKind::wall, 2 + k);
    city.add_ring(std::array{at(k, bottom_m), at(k + 1, bottom_m), at(k + 1, top_m), at(k, top_m)});
  }
}

CityModel houses() {
  CityModel city;
  add_box(city, "row", {0, -half_length_m}, {depth_m, half_length_m}, floor_m, roof_m);
  // So that the grid reaches downhill; it is too low to hide anything of the sky
  add_box(city, "bench", {-60, 0}, {-59, 1}, -12.0, -11.5);
  return city;
}

class FloorOnASlope : public testing::TestWithParam<double> {
 protected:
  FloorOnASlope() {
    LocatedCity located{houses(), {}};
    const Grid grid = scenes::grid_covering(located.city, Angle::degrees(GetParam()), 25.0, 3);
    Report report;
    const TileSet tiles = tiles::cut_into_tiles(std::move(located), grid, Assign::clip, slope(), report);
    foundations_ = tiles.foundation_count;
    scenes::pack_tiles(tiles, grid, folder_.path() / "slope.farlod", {});
    package_.emplace(folder_.path() / "slope.farlod");
  }
  /// A receiver at eye height; none where nobody can stand.
  [[nodiscard]] std::optional<CellReceivers> receiver_at(Point2d p_city) const {
    const Grid& grid = package_->grid();
    const Point2d p = grid.rotation.grid_from_city(p_city);
    const Cell cell = grid.cell_of(p);
    const Point2d in_cell = p - grid.corner_of(cell);
    const auto place = stand(PointLocator(*package_, cell), static_cast<float>(in_cell.x), static_cast<float>(in_cell.y),
                             HeightAbove::ground, static_cast<float>(eye_m));
    if (!place) return std::nullopt;
    return CellReceivers{cell, {{0, *place, {0.0F, 0.0F, 1.0F}}}};
  }

  scenes::TemporaryFolder folder_;
  std::optional<PackageReader> package_;
  std::uint64_t foundations_ = 0;
};

TEST_P(FloorOnASlope, GoesDownToTheGround) {
  EXPECT_EQ(foundations_, 1U);
  for (const double x : {0.1, 1.0, 2.4, 5.0, 9.0}) EXPECT_FALSE(receiver_at({x, 3.0})) << "below the floor, at " << x;
}

TEST_P(FloorOnASlope, IsAWallFromBelow) {
  for (const Engine engine : {Engine::exact, Engine::rays, Engine::automatic, Engine::horizon}) {
    SkySettings settings{.engine = engine, .rays = 4000, .azimuths = 1024};
    const SkyEvaluator evaluator(*package_, settings);
    for (const double distance : {1.0, 5.0, 20.0}) {
      const auto r = receiver_at({-distance, 3.0});
      ASSERT_TRUE(r);
      std::array<float, 1> svf{};
      evaluator.evaluate(*r, svf);
      const double above_eye = roof_m - (eye_m - climb * distance);
      EXPECT_NEAR(svf[0], oracles::finite_wall_cos(above_eye, distance, half_length_m - 3.0, half_length_m + 3.0),
                  sampling_error_of(settings))
          << distance << " m in front, engine " << static_cast<int>(engine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Turned, FloorOnASlope, testing::Values(0.0, 23.0));

}  // namespace
}  // namespace farlod::analytic
