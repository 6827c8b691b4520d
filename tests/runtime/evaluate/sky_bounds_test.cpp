// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "evaluate/error_budget.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "receivers/receiver.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/packed_once.hpp"

// What the far map of the kind `horizon` promises of whole answers, in towns with everything that hides the sky: towers, roofs,
// bridges that can be seen under, hills.

namespace farlod {
namespace {

constexpr std::size_t bounded_rays = 1000;
/// The near scene and the whole city round to floats in frames of their own: a ray that grazes an edge may pass it on either
/// side.
constexpr double one_bounded_ray = 1.5 / static_cast<double>(bounded_rays);

struct Town {
  const char* name;
  double cell_m;
  int neighborhood;
  double tower_share, relief_m;
  bool overhangs;
  double tolerance;
  Assign assign = Assign::clip;
};
void PrintTo(const Town& town, std::ostream* out) { *out << town.name; }

CityModel city_of(const Town& town) {
  CitySettings settings;
  settings.size_m = 400;
  settings.lod = 2;
  settings.tower_share = town.tower_share;
  settings.terrain_relief_m = town.relief_m;
  settings.overhangs = town.overhangs;
  settings.rotation_deg = 13;
  return scenes::generated_town(settings);
}

struct Answers {
  std::vector<float> svf, low, high;
};

class SkyBounds : public testing::TestWithParam<Town> {
 protected:
  SkyBounds() : package_(packed()), places_(some_places()) {}

  static bool pack(const std::filesystem::path& folder) {
    const Town& town = GetParam();
    const CityModel city = city_of(town);
    const Grid grid = scenes::grid_covering(city, Angle::degrees(13.0), town.cell_m, town.neighborhood, 4);
    FarMapSettings settings;
    settings.horizon.tolerance = town.tolerance;
    scenes::pack_city(city, grid, folder / "town.farlod", settings, town.assign);
    return true;
  }
  static std::filesystem::path packed() {
    return scenes::packed_once({std::string("bounds_") + GetParam().name, "", scenes::this_program()}, pack) / "town.farlod";
  }

  /// All over the town, on streets and roofs and high above both, a fifth of them tilted; none inside of a building.
  std::vector<CellReceivers> some_places() {
    const Grid& grid = package_.grid();
    std::vector<CellReceivers> places;
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
      const PointLocator locator(package_, grid.cells.cell_at(n));
      CellReceivers cell{grid.cells.cell_at(n), {}};
      const auto add = [&](float x, HeightAbove above, float height_m, const Point3f& normal) {
        const auto p = stand(locator, x, between(0, grid.cell_edge_m), above, height_m);
        if (p) cell.receivers.push_back({count_++, *p, normal});
      };
      const auto edge = grid.cell_edge_m;
      for (const float height_m : {1.5F, 12.0F, 60.0F}) add(between(0, edge), HeightAbove::ground, height_m, upwards);
      add(between(0, edge), HeightAbove::highest_surface, 0.3F, upwards);
      // Where squares and cells meet
      add(0.0F, HeightAbove::ground, 1.5F, upwards);
      add(static_cast<float>(0.5 * edge), HeightAbove::ground, 1.5F, normalized(Point3f{between(-1, 1), between(-1, 1), 0.5F}));
      places.push_back(std::move(cell));
    }
    return places;
  }

  float between(double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53);
  }

  [[nodiscard]] Answers answers(Engine engine, std::optional<double> max_far_error = std::nullopt) const {
    const SkyEvaluator evaluator(package_, {engine, SkyWeight::cosine, bounded_rays, max_far_error});
    Answers a{std::vector<float>(count_), std::vector<float>(count_), std::vector<float>(count_)};
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, SkyAnswers(a.svf, a.low, a.high));
    return a;
  }

  /// Horizons alone cannot do where something hangs.
  [[nodiscard]] static std::vector<Engine> engines_by_horizons() {
    if (GetParam().overhangs) return {Engine::automatic};
    return {Engine::automatic, Engine::horizon};
  }

  static constexpr Point3f upwards{0.0F, 0.0F, 1.0F};
  std::mt19937_64 random_{20120901};
  std::size_t count_ = 0;
  PackageReader package_;
  std::vector<CellReceivers> places_;
};

TEST_P(SkyBounds, HoldTheExactAnswer) {
  const Answers exact = answers(Engine::exact), bounded = answers(Engine::rays);
  double widest = 0.0;
  for (std::size_t n = 0; n < exact.svf.size(); ++n) {
    EXPECT_LE(bounded.low[n], exact.svf[n] + one_bounded_ray) << "receiver " << n;
    EXPECT_GE(bounded.high[n], exact.svf[n] - one_bounded_ray) << "receiver " << n;
    EXPECT_LE(bounded.low[n], bounded.svf[n]);
    EXPECT_LE(bounded.svf[n], bounded.high[n]);
    widest = std::max<double>(widest, bounded.high[n] - bounded.low[n]);
  }
  EXPECT_LT(*std::min_element(exact.svf.begin(), exact.svf.end()), 0.5F) << "the town hides too little to tell";
  if (GetParam().tolerance > 0.0) {
    EXPECT_GT(widest, 0.0) << "nothing is left open to tell";
  }
}

/// What horizons and the exact rays may differ by where all is certain: both look at parts of the sky only.
constexpr std::size_t bounded_azimuths = 256;
constexpr double rounding = 1e-6;  // of floats up to 1, and of sums of them
const double between_looks = azimuth_error(bounded_azimuths) + sampling_error(bounded_rays);

TEST_P(SkyBounds, OfHorizonsHoldTheExactAnswerUpToWhatIsBetweenAzimuths) {
  const Answers exact = answers(Engine::exact);
  for (const Engine engine : engines_by_horizons()) {
    const Answers bounded = answers(engine);
    for (std::size_t n = 0; n < exact.svf.size(); ++n) {
      EXPECT_LE(bounded.low[n], exact.svf[n] + between_looks) << "receiver " << n;
      EXPECT_GE(bounded.high[n], exact.svf[n] - between_looks) << "receiver " << n;
      EXPECT_LE(bounded.low[n], bounded.svf[n]);
      EXPECT_LE(bounded.svf[n], bounded.high[n]);
    }
  }
}

TEST_P(SkyBounds, OfHorizonsAreDecidedByRays) {
  constexpr double most = 0.005;
  const Answers exact = answers(Engine::exact), none = answers(Engine::automatic, 0.0), some = answers(Engine::automatic, most);
  for (std::size_t n = 0; n < exact.svf.size(); ++n) {
    EXPECT_EQ(none.low[n], none.high[n]) << "receiver " << n;
    EXPECT_NEAR(none.svf[n], exact.svf[n], between_looks) << "receiver " << n;
    EXPECT_NEAR(some.svf[n], exact.svf[n], most + between_looks) << "receiver " << n;
    EXPECT_LE(some.high[n] - some.svf[n], most + rounding) << "receiver " << n;
    EXPECT_LE(some.svf[n] - some.low[n], most + rounding) << "receiver " << n;
    EXPECT_LE(some.low[n], exact.svf[n] + between_looks) << "receiver " << n;
    EXPECT_GE(some.high[n], exact.svf[n] - between_looks) << "receiver " << n;
  }
}

TEST_P(SkyBounds, OfHorizonsNeedFewRaysWhereMuchMayStayOpen) {
  const auto rays_of = [&](double most) {
    const SkyEvaluator evaluator(package_, {Engine::automatic, SkyWeight::cosine, bounded_rays, most});
    std::vector<float> svf(count_);
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, svf);
    return evaluator.statistics().retraced_rays;
  };
  const std::uint64_t all = rays_of(0.0), some = rays_of(0.005);
  EXPECT_EQ(rays_of(1.0), 0U);
  if (GetParam().tolerance > 0.0) {
    EXPECT_GT(all, 0U);
  }
  EXPECT_LE(some, all / 2);
}

TEST_P(SkyBounds, WithoutAnyFarErrorTheAnswerIsExact) {
  const Answers exact = answers(Engine::exact), resolved = answers(Engine::rays, 0.0);
  for (std::size_t n = 0; n < exact.svf.size(); ++n) {
    EXPECT_NEAR(resolved.svf[n], exact.svf[n], one_bounded_ray) << "receiver " << n;
    EXPECT_EQ(resolved.low[n], resolved.high[n]) << "receiver " << n;
  }
}

TEST_P(SkyBounds, TheFarErrorStaysBelowTheMost) {
  constexpr double most = 0.005;
  const Answers exact = answers(Engine::exact), resolved = answers(Engine::rays, most);
  for (std::size_t n = 0; n < exact.svf.size(); ++n)
    EXPECT_NEAR(resolved.svf[n], exact.svf[n], most + one_bounded_ray) << "receiver " << n;
}

TEST_P(SkyBounds, AskingForThemChangesNoAnswer) {
  for (const Engine engine : {Engine::rays, Engine::automatic}) {
    const Answers bounded = answers(engine);
    const SkyEvaluator evaluator(package_, {engine, SkyWeight::cosine, bounded_rays});
    std::vector<float> plain(bounded.svf.size());
    for (const CellReceivers& cell : places_) evaluator.evaluate(cell, plain);
    // With bounds, rays answer for a few more of those who may look below something
    const double most = engine == Engine::rays ? 0.0 : between_looks;
    for (std::size_t n = 0; n < plain.size(); ++n) EXPECT_NEAR(plain[n], bounded.svf[n], most) << "receiver " << n;
  }
}

TEST_P(SkyBounds, RaysAreTracedAgainstTheWholeCityOnlyWhereTheyMust) {
  const SkyEvaluator lax(package_, {Engine::rays, SkyWeight::cosine, bounded_rays, 1.0}),
      strict(package_, {Engine::rays, SkyWeight::cosine, bounded_rays, 0.0});
  std::vector<float> svf(count_);
  for (const CellReceivers& cell : places_) {
    lax.evaluate(cell, svf);
    strict.evaluate(cell, svf);
  }
  EXPECT_EQ(lax.statistics().retraced_rays, 0U);
  EXPECT_LT(strict.statistics().retraced_rays, bounded_rays * svf.size() / 4);
}

INSTANTIATE_TEST_SUITE_P(
    Towns, SkyBounds,
    testing::Values(Town{"Plain", 50, 3, 0.0, 0.0, false, 0.05}, Town{"Towers", 50, 3, 1.0, 0.0, false, 0.05},
                    Town{"Bridges", 50, 3, 0.3, 0.0, true, 0.05}, Town{"BridgesOverHills", 50, 3, 0.3, 60.0, true, 0.05},
                    Town{"BridgesWholeBuildings", 50, 3, 0.3, 0.0, true, 0.05, Assign::whole},
                    Town{"SmallNeighborhood", 100, 1, 0.5, 20.0, true, 0.05}, Town{"CoarseMap", 50, 3, 0.5, 0.0, true, 0.5},
                    Town{"FineMap", 50, 3, 0.5, 0.0, true, 0.0}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlod
