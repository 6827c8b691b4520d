// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "evaluate/sky_evaluator.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/packed_around.hpp"
#include "tests/scenes/scene_builder.hpp"

// What is computed beside the sky view factor, against closed forms: in canyons that run at several bearings, in a round court
// and in the open, by horizons and by rays.

namespace farlod {
namespace {

using std::numbers::pi;

struct Canyon {
  double axis_deg;  ///< bearing
  double height_m = 20.0, right_m = 6.0, left_m = 9.0;
};

auto walls_of(const Canyon& c) {
  return [c](scenes::SceneBuilder& builder) {
    const Angle axis = Angle::degrees(c.axis_deg);
    const Point2d along{sin(axis), cos(axis)}, right{cos(axis), -sin(axis)};
    for (const double side : {c.right_m, -c.left_m})
      builder.add_wall(side * right - 900.0 * along, side * right + 900.0 * along, -packed_eye_m, c.height_m);
  };
}

/// ∫ dψ / (1 + t² sin² ψ) from 0 to ψ, for a wall whose horizon at its nearest point has the slope t.
double sky_up_to(double psi, double t) {
  const double root = std::sqrt(1.0 + t * t), turns = std::floor(psi / pi + 0.5);
  return (std::atan(root * std::tan(psi - turns * pi)) + turns * pi) / root;
}

/// The mean of the sky from one azimuth to another, clockwise, in degrees.
double sky_between(const Canyon& c, double from_deg, double to_deg) {
  // ψ counts clockwise from the axis: the wall on the right stands at 0 to π
  double sky = 0.0;
  const double from = (from_deg - c.axis_deg) * pi / 180.0, to = (to_deg - c.axis_deg) * pi / 180.0;
  for (double at = from; at < to - 1e-12;) {
    const double side = std::floor(at / pi + 1e-9), end = std::min(to, (side + 1.0) * pi);
    const bool is_right = static_cast<long>(side) % 2 == 0;
    const double t = c.height_m / (is_right ? c.right_m : c.left_m);
    sky += sky_up_to(end, t) - sky_up_to(at, t);
    at = end;
  }
  return sky / (to - from);
}

constexpr std::array engines{Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};

/// The azimuths err by less with horizons; rays of a degree with all halvings by a 256th of it.
constexpr double tolerance = 0.003;

TEST(FurtherQuantities, DirectionalValuesOfCanyonsAreKnown) {
  Quantities further{.directional = true};
  for (const double axis_deg : {0.0, 30.0, 90.0})
    for (const double grid_deg : {0.0, 20.0}) {
      const Canyon canyon{axis_deg};
      const PackedAround packed(Angle::degrees(grid_deg), walls_of(canyon));
      for (const Engine engine : engines) {
        SCOPED_TRACE(std::to_string(axis_deg) + ", grid " + std::to_string(grid_deg) + ", engine " +
                     std::to_string(static_cast<int>(engine)));
        auto got = packed.columns(engine, further);
        EXPECT_NEAR(got["svfE"], sky_between(canyon, 0.0, 180.0), tolerance);
        EXPECT_NEAR(got["svfS"], sky_between(canyon, 90.0, 270.0), tolerance);
        EXPECT_NEAR(got["svfW"], sky_between(canyon, 180.0, 360.0), tolerance);
        EXPECT_NEAR(got["svfN"], sky_between(canyon, -90.0, 90.0), tolerance);
        EXPECT_NEAR(0.5 * (got["svfE"] + got["svfW"]), got["svf"], 1e-6);
        EXPECT_NEAR(0.5 * (got["svfN"] + got["svfS"]), got["svf"], 1e-6);
      }
    }
}

TEST(FurtherQuantities, DistancesToTheHorizonAreThoseOfTheWalls) {
  Quantities further;
  further.directional = true;  // a column before, and one behind
  further.horizons = 8;
  further.horizon_distances = true;
  further.sun.emplace();
  const Canyon canyon{0.0};
  const PackedAround packed(Angle::degrees(20.0), walls_of(canyon));
  for (const Engine engine : engines) {
    SCOPED_TRACE(static_cast<int>(engine));
    auto got = packed.columns(engine, further);
    EXPECT_NEAR(got["distance_090"], canyon.right_m, 1e-3);
    EXPECT_NEAR(got["distance_270"], canyon.left_m, 1e-3);
    for (const char* diagonal : {"distance_045", "distance_135"})
      EXPECT_NEAR(got[diagonal], std::sqrt(2.0) * canyon.right_m, 1e-3);
    EXPECT_TRUE(std::isnan(got["distance_000"])) << got["distance_000"];  // along the canyon, where the horizon is level
    EXPECT_NEAR(got["horizon_090"], std::atan2(canyon.height_m, canyon.right_m) * 180.0 / pi, 0.02);
    EXPECT_EQ(got["sunlit_h"], 0.0);
  }
}

TEST(FurtherQuantities, DistancesReachBeyondTheNeighborhood) {
  Quantities further{.horizons = 4, .horizon_distances = true};
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    builder.add_wall({-300.0, 700.0}, {300.0, 700.0}, -packed_eye_m, 90.0);
    builder.add_wall({-10.0, 15.0}, {10.0, 15.0}, -packed_eye_m, 1.0);  // nearer, and below the horizon
  });
  for (const Engine engine : engines) EXPECT_NEAR(packed.columns(engine, further)["distance_000"], 700.0, 0.01);
}

TEST(FurtherQuantities, AreOneInTheOpen) {
  Quantities further;
  further.directional = further.svf_solid = further.hidden = true;
  further.horizons = 36;
  further.sky_patches = SkyPatchSet::tregenza;
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  for (const Engine engine : engines)
    for (const auto& [name, value] : open.columns(engine, further)) {
      const bool is_zero = name.starts_with("hidden") || name.starts_with("horizon");
      EXPECT_NEAR(value, is_zero ? 0.0 : 1.0, is_zero && name.starts_with("horizon") ? 0.01 : 1e-5) << name;
    }
}

TEST(FurtherQuantities, SolidAngleIsThatOfARunByItself) {
  Quantities further{.svf_solid = true};
  const Canyon canyon{30.0};
  const PackedAround packed({}, walls_of(canyon));
  const double expected = 1.0 - (std::atan(canyon.height_m / canyon.right_m) + std::atan(canyon.height_m / canyon.left_m)) / pi;
  for (const Engine engine : engines) EXPECT_NEAR(packed.columns(engine, further)["svf_solid"], expected, tolerance);
}

TEST(FurtherQuantities, HorizonsOfACanyonAreKnown) {
  Quantities further{.horizons = 24};
  const Canyon canyon{30.0};
  const PackedAround packed(Angle::degrees(10.0), walls_of(canyon));
  for (const Engine engine : engines) {
    auto got = packed.columns(engine, further);
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
      const double across = std::sin((azimuth_deg - canyon.axis_deg) * pi / 180.0);
      const double distance_m = across >= 0.0 ? canyon.right_m : canyon.left_m;
      const double expected_deg = std::atan(canyon.height_m * std::abs(across) / distance_m) * 180.0 / pi;
      std::string name = std::to_string(azimuth_deg);
      name = "horizon_" + std::string(3 - name.size(), '0') + name;
      ASSERT_TRUE(got.contains(name)) << name;
      // Along the canyon, walls end far away
      EXPECT_NEAR(got[name], expected_deg, std::abs(across) < 1e-6 ? 1.5 : 0.02) << name;
    }
  }
}

TEST(FurtherQuantities, HorizonsGiveTheSkyViewFactorBack) {
  Quantities further{.horizons = 360};
  const Canyon canyon{30.0};
  const PackedAround packed({}, walls_of(canyon));
  for (const Engine engine : engines) {
    double mean = 0.0;
    auto got = packed.columns(engine, further);
    for (const auto& [name, value] : got)
      if (name.starts_with("horizon")) mean += std::pow(std::cos(value * pi / 180.0), 2) / 360.0;
    EXPECT_NEAR(mean, got["svf"], 0.002);
  }
}

double view_factor_of_band(double from_deg, double to_deg) {
  return std::pow(std::sin(to_deg * pi / 180.0), 2) - std::pow(std::sin(from_deg * pi / 180.0), 2);
}

TEST(FurtherQuantities, PatchesAddUpToTheSkyViewFactor) {
  const Canyon canyon{30.0};
  const PackedAround packed({}, walls_of(canyon));
  for (const SkyPatchSet set : {SkyPatchSet::tregenza, SkyPatchSet::reinhart}) {
    Quantities further{.sky_patches = set};
    const int parts = set == SkyPatchSet::tregenza ? 1 : 2;
    std::vector<int> bands;
    for (const int count : {30, 30, 24, 24, 18, 12, 6}) bands.insert(bands.end(), static_cast<std::size_t>(parts), parts * count);
    const double height_deg = 90.0 / (static_cast<double>(bands.size()) + 0.5);
    for (const Engine engine : engines) {
      auto got = packed.columns(engine, further);
      EXPECT_EQ(columns_of(further).size(), set == SkyPatchSet::tregenza ? 145U : 577U);
      double sum = 0.0;
      std::size_t patch = 0;
      const std::vector<std::string> names = columns_of(further);
      for (std::size_t band = 0; band < bands.size(); ++band)
        for (int n = 0; n < bands[band]; ++n)
          sum += got[names[patch++]] *
                 view_factor_of_band(static_cast<double>(band) * height_deg, static_cast<double>(band + 1) * height_deg) /
                 bands[band];
      sum += got[names[patch]] * view_factor_of_band(static_cast<double>(bands.size()) * height_deg, 90.0);
      EXPECT_NEAR(sum, got["svf"], 0.005);
    }
  }
}

TEST(FurtherQuantities, PatchesAreCountedFromNorthClockwise) {
  Quantities further{.sky_patches = SkyPatchSet::tregenza};
  // A wall in the east hides the lowest patches there: the eighth is centred at 84°, the 23rd at 264°
  const PackedAround packed(Angle::degrees(20.0), [](scenes::SceneBuilder& builder) {
    builder.add_wall({8.0, -300.0}, {8.0, 300.0}, -packed_eye_m, 30.0);
  });
  for (const Engine engine : engines) {
    auto got = packed.columns(engine, further);
    EXPECT_NEAR(got["patch_008"], 0.0, 1e-6);
    EXPECT_NEAR(got["patch_023"], 1.0, 1e-6);
    EXPECT_NEAR(got["patch_145"], 1.0, 1e-6);
    EXPECT_NEAR(got["patch_038"], 0.0, 1e-6) << "the second band begins at the 31st";
  }
}

TEST(FurtherQuantities, HiddenSharesAddUpAndAreOfTheirGeometry) {
  Quantities further{.hidden = true};
  // A wall 5 m away in the cell, and a tower beyond it, which alone is seen in the west
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    builder.add_wall({5.0, -15.0}, {5.0, 15.0}, -packed_eye_m, 4.0);
    builder.add_box({{-400.0, -60.0}, {-300.0, 60.0}}, -packed_eye_m, 200.0);
  });
  const double near = 1.0 - oracles::finite_wall_cos(4.0, 5.0, 15.0, 15.0),
               far = 1.0 - oracles::finite_wall_cos(200.0, 300.0, 60.0, 60.0);
  for (const Engine engine : engines) {
    auto got = packed.columns(engine, further);
    EXPECT_NEAR(got["hidden_near"], near, tolerance);
    EXPECT_NEAR(got["hidden_far"], far, tolerance);
    EXPECT_NEAR(got["hidden_near"] + got["hidden_far"] + got["svf"], 1.0, 1e-6);
  }
}

TEST(FurtherQuantities, SunlitHoursAreThoseAboveTheHorizonAndInFront) {
  Quantities further;
  further.sun.emplace();
  // 30° high in all azimuths, a minute each degree of them, and below the horizon
  for (int azimuth_deg = 0; azimuth_deg < 360; ++azimuth_deg) {
    further.sun->push_back({Angle::degrees(azimuth_deg + 0.5), Angle::degrees(30.0), 1.0 / 60.0});
    further.sun->push_back({Angle::degrees(azimuth_deg + 0.5), Angle::degrees(-1.0), 1.0});
  }
  const Canyon canyon{30.0};
  const PackedAround packed(Angle::degrees(20.0), walls_of(canyon));
  // The wall hides the sun where H |sin ψ| / d > tan 30°
  const auto seen_turn = [&](double distance_m) {
    return 2.0 * std::asin(std::tan(pi / 6.0) * distance_m / canyon.height_m) / (2.0 * pi);
  };
  const double hours = 6.0 * (seen_turn(canyon.right_m) + seen_turn(canyon.left_m));
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  for (const Engine engine : engines) {
    EXPECT_NEAR(packed.columns(engine, further)["sunlit_h"], hours, 0.05);
    EXPECT_NEAR(open.columns(engine, further)["sunlit_h"], 6.0, 1e-5);
    // A wall that faces west sees half of the turn; a roof that is tilted by 60° all but where tan 30° < tan 60° · −cos ψ
    EXPECT_NEAR(open.columns(engine, further, {-1.0, 0.0, 0.0})["sunlit_h"], 3.0, 0.02);
    const double behind = std::acos(std::tan(pi / 6.0) / std::tan(pi / 3.0)) / pi;
    const Angle tilt = Angle::degrees(60.0);
    EXPECT_NEAR(open.columns(engine, further, {-sin(tilt), 0.0, cos(tilt)})["sunlit_h"], 6.0 * (1.0 - behind), 0.02);
  }
}

TEST(FurtherQuantities, SkyBelowAnOverhangCountsWhereItIsSeen) {
  Quantities further{.directional = true, .sky_patches = SkyPatchSet::tregenza};
  // Below a wide roof without walls, and a wall in the west that leaves no gap there
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    builder.add_box({{-14.0, -14.0}, {14.0, 14.0}}, 3.0, 3.5);
    builder.add_wall({-13.9, -13.9}, {-13.9, 13.9}, -packed_eye_m, 3.0);
  });
  std::map<std::string, double> by_engine;
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    auto got = packed.columns(engine, further);
    EXPECT_GT(got["svf"], 0.02);
    EXPECT_GT(got["svfE"], 1.5 * got["svfW"]);
    EXPECT_NEAR(got["patch_145"], 0.0, 1e-6);
    EXPECT_GT(got["patch_008"], 0.3);
    EXPECT_NEAR(got["patch_023"], 0.0, 1e-6);
    for (const char* name : {"svfN", "svfE", "svfS", "svfW"}) {
      const auto [known, is_first] = by_engine.try_emplace(name, got[name]);
      if (!is_first) {
        EXPECT_NEAR(got[name], known->second, 0.01) << name;
      }
    }
  }
}

}  // namespace
}  // namespace farlod
