// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// Every scene with a known answer goes the whole way, from facets to a package and back, with all of its geometry near,
// all of it in the far map, and some of it in each; on both engines, with far maps of both kinds; on grids that are turned three
// ways.

namespace farlod {
namespace {

using scenes::SceneBuilder;

constexpr double eye_m = 1.5;      // receivers stand this high, as the far maps are captured
constexpr double ground = -eye_m;  // scenes are drawn around the eye
constexpr std::size_t rays = 200000;

FarMapSettings maps_of(FarMapKind kind) { return kind == FarMapKind::box ? scenes::box_maps(256, 256) : FarMapSettings{}; }

struct Scene {
  std::string name;
  std::function<void(SceneBuilder&)> build;
  double svf_cos, svf_solid;     // NaN: no closed form
  double nearest_m, farthest_m;  // how near and how far its geometry is
  double rise;                   // total variation of tan β along the circle
  double extra_error = 0.0;      // of the scene itself, where it stands in for a smooth one
  Point3d normal{0.0, 0.0, 1.0};
  bool is_overhead = false;  ///< the part right above the cell is near in any case
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

constexpr double no_closed_form = std::numeric_limits<double>::quiet_NaN();

/// A wall that is drawn from −a1 to a2 at distance d; "endless" ones end six distances away, and the oracle knows.
Scene finite_wall(const std::string& name, double H, double d, double a1, double a2) {
  return {name,
          [=](SceneBuilder& s) {
            s.add_wall({-a1, d}, {a2, d}, ground, H);
          },
          oracles::finite_wall_cos(H, d, a1, a2),
          oracles::finite_wall_solid(H, d, a1, a2),
          d,
          std::hypot(d, std::max(a1, a2)),
          2 * H / d};
}

Scene canyon(double H1, double H2, double W, double x) {
  const double a = 4 * W;
  const auto hidden = [&](double svf_wall_1, double svf_wall_2) { return 1.0 - (1.0 - svf_wall_1) - (1.0 - svf_wall_2); };
  return {"Canyon",
          [=](SceneBuilder& s) {
            s.add_wall({-x, -a}, {-x, a}, ground, H1);
            s.add_wall({W - x, -a}, {W - x, a}, ground, H2);
          },
          hidden(oracles::finite_wall_cos(H1, x, a, a), oracles::finite_wall_cos(H2, W - x, a, a)),
          hidden(oracles::finite_wall_solid(H1, x, a, a), oracles::finite_wall_solid(H2, W - x, a, a)),
          std::min(x, W - x),
          std::hypot(a, W),
          2 * H1 / x + 2 * H2 / (W - x)};
}

/// A polygon of n sides around the circle: its sides come nearer than the circle by 1 − cos(π/n) of the radius, which raises tan
/// β by that share of at most H over the least distance.
Scene round_court(const std::string& name, double R, double H, double r) {
  constexpr int n = 360;
  const double nearest = R - std::abs(r);
  const double polygon_error = steepest_solid * H / nearest * (1 - std::cos(std::numbers::pi / n)) * R / nearest;
  return {name,
          [=](SceneBuilder& s) {
            const auto corner = [=](int k) {
              return Point2d{r + R * std::cos(2 * std::numbers::pi * k / n), R * std::sin(2 * std::numbers::pi * k / n)};
            };
            for (int k = 0; k < n; ++k) s.add_wall(corner(k), corner(k + 1), ground, H);
          },
          oracles::round_court_cos(R, H, r),
          r == 0 ? oracles::basin_solid(std::atan(H / R)) : no_closed_form,
          nearest,
          R + std::abs(r),
          2 * (H / nearest - H / (R + std::abs(r))),
          polygon_error};
}

Scene rectangular_court(double west, double east, double south, double north, double H) {
  double cos = 0, solid = 0;
  for (const double a : {west, east})
    for (const double b : {south, north}) {
      cos += oracles::court_quadrant_cos(a, b, H);
      solid += oracles::court_quadrant_solid(a, b, H);
    }
  return {"RectangularCourt",
          [=](SceneBuilder& s) {
            const std::vector<Point2d> c{{-west, -south}, {east, -south}, {east, north}, {-west, north}};
            for (std::size_t k = 0; k < 4; ++k) s.add_wall(c[k], c[(k + 1) % 4], ground, H);
          },
          cos,
          solid,
          std::min({west, east, south, north}),
          std::hypot(std::max(west, east), std::max(south, north)),
          2 * (H / west + H / east + H / south + H / north)};
}

/// A point of a canyon's wall looks across at a wall whose top is q higher; its own wall is behind it.
Scene wall_point(double q, double W) {
  const double a = 6 * W;
  // The opposite wall is finite: what it hides is, as for a horizontal receiver, below the tail of an endless one
  const double tail = q / W * std::pow(W / a, 2) / 2;
  return {"WallPoint",
          [=](SceneBuilder& s) {
            s.add_wall({W, -a}, {W, a}, ground, q);
          },
          oracles::wall_point_cos(q, W),
          oracles::wall_point_solid(q, W),
          W,
          std::hypot(a, W),
          2 * q / W,
          tail,
          {1.0, 0.0, 0.0}};
}

Scene tilted_in_the_open(double tilt_deg) {
  const Angle t = Angle::degrees(tilt_deg);
  return {"Tilted" + std::to_string(static_cast<int>(tilt_deg)),
          [](SceneBuilder&) {},
          oracles::tilted_cos(t.radians()),
          1.0 - t.radians() / std::numbers::pi,
          1.0,
          1.0,
          0.0,
          0.0,
          {sin(t), 0.0, cos(t)}};
}

/// A half plane overhead, cut off far away: what lies beyond hides no more than an endless wall of its height there.
Scene overhang(const std::string& name, double h, double e, bool under) {
  const double far = 60 * h, edge = under ? e : -e;
  return {name,
          [=](SceneBuilder& s) {
            s.add_polygon({{edge - far, -far, h}, {edge, -far, h}, {edge, far, h}, {edge - far, far, h}});
          },
          oracles::overhang_cos(h, e, under),
          no_closed_form,
          4 * h,
          far * 1.5,
          0.0,
          4 * (1 - oracles::wall_cos(h, far - e)),
          {0.0, 0.0, 1.0},
          true};
}

enum class Share { all_near, all_far, split };

struct Setup {
  Share share;
  Engine engine;
  FarMapKind kind;
  double bearing_deg;
};

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

CityModel city_of(const Scene& scene, double cell_edge_m, const GridRotation& rotation) {
  const Point2d middle_city = rotation.city_from_grid(Point2d{0.5 * cell_edge_m, 0.5 * cell_edge_m});
  SceneBuilder builder({middle_city.x, middle_city.y, eye_m});
  scene.build(builder);
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
    double likely, low, high;
  };
  [[nodiscard]] Svf evaluate(Engine engine, SkyWeight weight, std::optional<double> max_far_error = std::nullopt) const {
    std::vector<float> likely(1), low(1), high(1);
    SkyEvaluator(package_, {engine, weight, rays, max_far_error}).evaluate(receiver_, SkyAnswers(likely, low, high));
    return {likely[0], low[0], high[0]};
  }
  [[nodiscard]] const Package& package() const { return package_; }

 private:
  Package packed(const Scene& scene, const Setup& setup) const {
    const double cell_edge_m = exact_cell_edge_m(cell_edge_for(scene, setup.share));
    const Angle bearing = Angle::degrees(setup.bearing_deg);
    const CityModel city = city_of(scene, cell_edge_m, GridRotation(bearing));
    const Grid grid = scenes::grid_covering(city, bearing, cell_edge_m, 1, 1);
    scenes::pack_city(city, grid, folder_.path() / "scene.farlod", maps_of(setup.kind), Assign::clip, {{Cell{0, 0}}});
    return Package(folder_.path() / "scene.farlod");
  }

  scenes::TemporaryFolder folder_;
  Package package_;
  CellReceivers receiver_;
};

/// The border of the sky is no longer than the circle twice over: once along the horizon, once up and down its jumps.
double allowed_sampling(const Scene& scene) { return sampling_error(rays, 4 * std::numbers::pi) + scene.extra_error; }

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};

double known_answer(const Scene& scene, SkyWeight weight) {
  return weight == SkyWeight::cosine ? scene.svf_cos : scene.svf_solid;
}

class AnalyticScene : public testing::TestWithParam<std::tuple<Scene, Setup>> {};

TEST_P(AnalyticScene, HasItsKnownSkyViewFactor) {
  const auto& [scene, setup] = GetParam();
  if (setup.kind == FarMapKind::box && setup.share == Share::all_far && scene.is_overhead)
    GTEST_SKIP() << "from below, a roof has no horizon whose texels could be counted";
  const PackedScene packed(scene, setup);
  for (const SkyWeight weight : both_weights) {
    const double expected = known_answer(scene, weight);
    if (std::isnan(expected)) continue;
    // What the far map of the kind `horizon` leaves open is traced: its own error is nothing
    const bool settles = setup.engine == Engine::rays && setup.kind == FarMapKind::horizon;
    const double svf = packed.evaluate(setup.engine, weight, settles ? std::optional(0.0) : std::nullopt).likely;
    const double steepest = weight == SkyWeight::cosine ? steepest_cos : steepest_solid;
    double tolerance = allowed_sampling(scene);
    if (setup.engine == Engine::rays && setup.kind == FarMapKind::box && setup.share != Share::all_near)
      tolerance += box_map_error(packed.package().box_far_map({0, 0}).shape(), scene.rise, steepest);
    EXPECT_NEAR(svf, expected, tolerance) << (weight == SkyWeight::cosine ? "cosine" : "solid angle");
  }
}

class AnalyticBounds : public AnalyticScene {};

TEST_P(AnalyticBounds, HoldTheKnownSkyViewFactor) {
  const auto& [scene, setup] = GetParam();
  const PackedScene packed(scene, setup);
  for (const SkyWeight weight : both_weights) {
    const double expected = known_answer(scene, weight);
    if (std::isnan(expected)) continue;
    const auto [likely, low, high] = packed.evaluate(setup.engine, weight);
    EXPECT_LE(low, likely);
    EXPECT_LE(likely, high);
    EXPECT_LE(low, expected + allowed_sampling(scene));
    EXPECT_GE(high, expected - allowed_sampling(scene));
    // Only what is far leaves anything open
    if (setup.share == Share::all_near) {
      EXPECT_EQ(low, high);
    }
  }
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<Scene, Setup>>& info) {
  const auto& [scene, setup] = info.param;
  const char* share = setup.share == Share::all_near ? "Near" : setup.share == Share::all_far ? "Far" : "Split";
  const std::string engine = setup.engine == Engine::exact ? "Exact" : std::string("Rays") + scenes::name_of(setup.kind);
  return scene.name + share + engine + std::to_string(static_cast<int>(setup.bearing_deg));
}

std::vector<Setup> all_setups() {
  std::vector<Setup> setups;
  for (const double bearing_deg : {0.0, 17.0, 45.0}) {
    for (const Share share : {Share::all_near, Share::all_far, Share::split})
      for (const FarMapKind kind : {FarMapKind::box, FarMapKind::horizon})
        setups.push_back({share, Engine::rays, kind, bearing_deg});
    // The exact engine knows no near and far; how the tiles are cut must not matter to it
    setups.push_back({Share::split, Engine::exact, FarMapKind::box, bearing_deg});
  }
  return setups;
}

std::vector<Setup> setups_with_bounds() {
  std::vector<Setup> setups = all_setups();
  std::erase_if(setups, [](const Setup& s) { return s.engine != Engine::rays || s.kind != FarMapKind::horizon; });
  return setups;
}

std::vector<Scene> all_scenes() {
  return {finite_wall("LongWall", 20, 12, 72, 72),
          finite_wall("FiniteWall", 20, 12, 30, 7),
          canyon(20, 14, 15, 4),
          round_court("Basin", 25, 20, 0),
          round_court("RoundCourt", 25, 20, 10),
          rectangular_court(9, 14, 11, 20, 16),
          wall_point(12, 15),
          tilted_in_the_open(35),
          tilted_in_the_open(90),
          overhang("UnderOverhang", 4, 3, true),
          overhang("BesideOverhang", 4, 3, false)};
}

INSTANTIATE_TEST_SUITE_P(All, AnalyticScene, testing::Combine(testing::ValuesIn(all_scenes()), testing::ValuesIn(all_setups())),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(All, AnalyticBounds,
                         testing::Combine(testing::ValuesIn(all_scenes()), testing::ValuesIn(setups_with_bounds())),
                         name_of_case);

}  // namespace
}  // namespace farlod
