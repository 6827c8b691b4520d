// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "evaluate/error_budget.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"
#include "package/package_reader.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/agreement/random_receivers.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/packed_once.hpp"
#include "tests/scenes/scene_builder.hpp"

// Horizons against rays, in a town with roofs, towers and bridges that can be seen under: in streets, on roofs and on walls.

namespace farlod {
namespace {

/// The town, with this neighborhood; with bridges and upper floors that hang over the street, or without.
class PackedTown {
 public:
  PackedTown(int neighborhood, bool overhangs) : package_(packed(neighborhood, overhangs)) {}
  [[nodiscard]] const PackageReader& package() const { return package_; }

 private:
  static std::filesystem::path packed(int neighborhood, bool overhangs) {
    const std::string name = "horizons_" + std::to_string(neighborhood) + (overhangs ? "_overhangs" : "_standing");
    const auto pack = [&](const std::filesystem::path& folder) { return pack_into(folder, neighborhood, overhangs); };
    return scenes::packed_once({name, "", scenes::this_program()}, pack) / "town.farlod";
  }
  static bool pack_into(const std::filesystem::path& folder, int neighborhood, bool overhangs) {
    CitySettings settings{.size_m = 500, .lod = 2, .overhangs = overhangs};
    const CityModel city = scenes::generated_town(settings);
    const Grid grid = scenes::grid_covering(city, Angle::degrees(23.0), 50.0, neighborhood);
    scenes::pack_city(city, grid, folder / "town.farlod");
    return true;
  }
  PackageReader package_;
};

using Receivers = std::vector<CellReceivers>;

/// Groups of receivers a metre apart, as on a raster, outside of buildings: what they see is computed together.
Receivers in_streets(const PackageReader& package, std::size_t groups) {
  RandomSky random;
  Receivers receivers;
  std::size_t index = 0;
  for (std::size_t group = 0; group < groups; ++group) {
    const CellReceivers first = random.receiver(package);
    const PointLocator locator(package, first.cell);
    receivers.push_back({first.cell, {}});
    for (int n = 0; n < 16; ++n) {
      const Point3f& p = first.receivers[0].p_cell;
      const float x = p.x + static_cast<float>(n % 4), y = p.y + static_cast<float>(n / 4);
      const auto place = stand(locator, x, y, HeightAbove::ground, 1.5F);
      const bool is_in_cell = std::max(x, y) < static_cast<float>(package.grid().cell_edge_m);
      if (place && is_in_cell) receivers.back().receivers.push_back({index++, *place});
    }
  }
  return receivers;
}

/// About as many as wanted, spread over all cells.
Receivers on_surfaces(const PackageReader& package, SurfaceChoice choice, std::size_t count) {
  Receivers all;
  std::size_t found = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(package.grid().cells.size()); ++n) {
    const Cell cell = package.grid().cells.cell_at(n);
    all.push_back({cell, {}});
    for (const SurfaceReceiver& r : surface_receivers(package, cell, choice, 8.0))
      if (!r.is_inside_building) all.back().receivers.push_back({found++, r.p_cell, r.normal});
  }
  const std::size_t every = std::max<std::size_t>(1, found / count);
  std::size_t index = 0;
  for (CellReceivers& cell : all) {
    std::erase_if(cell.receivers, [&](const Receiver& r) { return r.index % every != 0; });
    for (Receiver& r : cell.receivers) r.index = index++;
  }
  return all;
}

std::size_t count_of(const Receivers& receivers) {
  std::size_t count = 0;
  for (const CellReceivers& cell : receivers) count += cell.receivers.size();
  return count;
}

std::vector<double> svf_of(const SkyEvaluator& evaluator, const Receivers& receivers) {
  std::vector<float> svf(count_of(receivers), -1.0F);
  for (const CellReceivers& cell : receivers) evaluator.evaluate(cell, svf);
  return {svf.begin(), svf.end()};
}

struct Standing {
  const char* name;
  Receivers (*receivers)(const PackageReader&);
};
void PrintTo(const Standing& where, std::ostream* out) { *out << where.name; }

/// Exact rays so many that they are the truth, and what they leave unseen.
constexpr std::size_t many = 20000;
std::vector<double> truth_of(const PackageReader& package, const Receivers& receivers) {
  return svf_of(SkyEvaluator(package, {Engine::exact, SkyWeight::cosine, many}), receivers);
}

/// Standing something hangs over a receiver's horizon, rays stand in: as many as the truth has.
SkySettings automatic_with(std::size_t azimuths) {
  SkySettings settings{Engine::automatic, SkyWeight::cosine, many};
  settings.azimuths = azimuths;
  return settings;
}

class Horizons : public testing::TestWithParam<Standing> {};

TEST_P(Horizons, WhereAllIsNearAndStandsAreWithinTheirBudget) {
  const PackedTown town(41, false);
  const Receivers receivers = GetParam().receivers(town.package());
  const std::vector<double> exact = truth_of(town.package(), receivers);
  ASSERT_GT(exact.size(), 300U);
  EXPECT_LT(*std::min_element(exact.begin(), exact.end()), 0.5) << "the town hides too little to tell";
  double mean_before = 1.0;
  for (const std::size_t azimuths : {128U, 256U, 512U}) {
    const SkyEvaluator evaluator(town.package(), automatic_with(azimuths));
    const ErrorSummary errors = summarize_errors(svf_of(evaluator, receivers), exact);
    EXPECT_EQ(evaluator.statistics().by_rays, 0U) << "nothing hangs: no rays need to stand in";
    RecordProperty("max_error_" + std::to_string(azimuths), std::to_string(errors.max_abs_error));
    RecordProperty("mean_error_" + std::to_string(azimuths), std::to_string(errors.mean_abs_error));
    const double most = azimuth_error(azimuths) + sampling_error(many);
    EXPECT_LE(errors.max_abs_error, most) << azimuths;
    // Errors of single azimuths have either sign: on average they are far below the largest
    EXPECT_LE(errors.mean_abs_error, most / 4.0) << azimuths;
    EXPECT_LE(std::abs(errors.bias), most / 8.0) << azimuths;
    EXPECT_LT(errors.mean_abs_error, mean_before) << azimuths;
    mean_before = errors.mean_abs_error;
  }
}

TEST_P(Horizons, WithRaysForOverhangsAreWithinTheirBoundsAndTheirBudget) {
  const PackedTown town(3, true);
  const Receivers receivers = GetParam().receivers(town.package());
  const std::vector<double> exact = truth_of(town.package(), receivers);
  for (const std::size_t azimuths : {128U, 256U, 512U}) {
    const SkyEvaluator evaluator(town.package(), automatic_with(azimuths));
    std::vector<float> svf(exact.size()), low(exact.size()), high(exact.size());
    for (const CellReceivers& cell : receivers) evaluator.evaluate(cell, SkyAnswers(svf, low, high));
    const ErrorSummary errors = summarize_errors(std::vector<double>(svf.begin(), svf.end()), exact);
    RecordProperty("max_error_" + std::to_string(azimuths), std::to_string(errors.max_abs_error));
    RecordProperty("mean_error_" + std::to_string(azimuths), std::to_string(errors.mean_abs_error));
    const double most = azimuth_error(azimuths) + sampling_error(many);
    for (std::size_t n = 0; n < exact.size(); ++n) {
      EXPECT_LE(low[n], exact[n] + most) << azimuths << " azimuths, receiver " << n;
      EXPECT_GE(high[n], exact[n] - most) << azimuths << " azimuths, receiver " << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Town, Horizons,
    testing::Values(Standing{"Streets", [](const PackageReader& p) { return in_streets(p, 40); }},
                    Standing{"Roofs", [](const PackageReader& p) { return on_surfaces(p, SurfaceChoice::roofs, 400); }},
                    Standing{"Walls", [](const PackageReader& p) { return on_surfaces(p, SurfaceChoice::walls, 400); }}),
    [](const auto& test) { return test.param.name; });

TEST(Agreement, RaysInANeighborhoodThatCoversTheCityAreExactRays) {
  const PackedTown town(41, true);
  const PackageReader& package = town.package();
  constexpr std::size_t rays_each = 5000;
  const Receivers receivers = in_streets(package, 20);
  const std::vector<double> exact = svf_of(SkyEvaluator(package, {Engine::exact, SkyWeight::cosine, rays_each}), receivers),
                            rays = svf_of(SkyEvaluator(package, {Engine::rays, SkyWeight::cosine, rays_each}), receivers);
  double differences = 0.0;
  for (std::size_t n = 0; n < exact.size(); ++n) differences += std::abs(rays[n] - exact[n]) * static_cast<double>(rays_each);
  // Horizons are told from edges, the exact scene is traced: a ray that grazes an edge may pass it on either side, but no more
  // than one in 100,000
  EXPECT_LE(std::lround(differences), static_cast<long>(exact.size() * rays_each / 100000));
}

// Surveyed walls lean out by centimetres: the roof's border is then ahead of them, with no soffit below it.

/// A house that is wider by `lean_m` to the east at its roof than at its foot, and by `eave_m` to the west.
std::vector<float> svf_of_leaning_wall(double lean_m, double height_m, double eave_m, Engine engine) {
  scenes::SceneBuilder builder;
  const std::vector<Point2d> foot{{6, 6}, {14, 6}, {14, 14}, {6, 14}};
  builder.add_frustum(foot, 0.0, {{6 - eave_m, 6}, {14 + lean_m, 6}, {14 + lean_m, 14}, {6 - eave_m, 14}}, height_m);
  const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 1);
  const scenes::TemporaryFolder folder;
  scenes::pack_city(builder.city(), grid, folder.path() / "house.farlod", {});
  const PackageReader package(folder.path() / "house.farlod");
  SkySettings settings{engine, SkyWeight::cosine, 4000};
  settings.azimuths = 1024;
  const SkyEvaluator evaluator(package, settings);
  std::vector<float> found;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    for (const SurfaceReceiver& r : surface_receivers(package, cell, SurfaceChoice::walls, 1.0)) {
      if (r.normal.x < 0.5F) continue;
      EXPECT_FALSE(r.is_inside_building);
      std::array<float, 1> svf{};
      evaluator.evaluate(CellReceivers{cell, {{0, r.p_cell, r.normal}}}, svf);
      found.push_back(svf[0]);
    }
  }
  return found;
}

struct Lean {
  double lean_m, height_m;
};
class LeaningWalls : public testing::TestWithParam<Lean> {};

TEST_P(LeaningWalls, SeeTheSkyOfATiltedPlaneInEveryEngine) {
  const auto [lean_m, height_m] = GetParam();
  // Nothing but the wall and the ground: the sky above a plane whose normal is tilted below the horizontal
  const double known = 0.5 * (1.0 - lean_m / std::hypot(lean_m, height_m));
  // With the eave, sky may be seen below the house: its edges are not grounded
  for (const double eave_m : {0.0, 0.5})
    for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
      const std::vector<float> svf = svf_of_leaning_wall(lean_m, height_m, eave_m, engine);
      ASSERT_GE(svf.size(), static_cast<std::size_t>(8 * height_m));
      // 4,000 rays, and the centimetre by which a receiver stands before its wall, seen from the roof's border and from the
      // ground
      for (const float s : svf) EXPECT_NEAR(s, known, 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(Metres, LeaningWalls,
                         testing::Values(Lean{0.0, 5.0}, Lean{0.008, 5.0}, Lean{0.02, 5.0}, Lean{0.045, 5.0}, Lean{0.2, 5.0},
                                         Lean{0.04, 15.0}, Lean{0.1, 15.0}));

}  // namespace
}  // namespace farlod
